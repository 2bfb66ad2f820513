#pragma once
// The second engine: runs simulated forward in closed loop by the plant that the server runs, with the case's controller or
// a stand-in that tracks the recorded motion. The torque command, the sensors and the power are what tells.

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/diagnose/figures.h"
#include "tools/diagnose/forward/axis_by_run.h"
#include "tools/identify/closed_loop.h"

namespace feedtwin::tools::diagnosis {

class RulingsBefore;

class ForwardModel {
 public:
  /// So many samples that the rest of a diagnosis takes a minute or two on two cores.
  static constexpr std::uint64_t usual_samples = 50'000'000;

  /// @param recordings of the case, or some of them; must outlive this
  /// @param most_samples that are simulated before no more is asked
  ForwardModel(const std::vector<Recording>& recordings, const Case& data, std::uint64_t most_samples = usual_samples);

  /// The scatter of the meter's readings, as a share of each or, where they err alike, in W, from the differences of
  /// neighbouring residuals.
  void learn_meter_noise(const AxisByRun& axis);
  void take_meter_from(const ForwardModel& other) { meter_share_ = other.meter_share_; }

  [[nodiscard]] const std::vector<ClosedLoopRun>& runs() const { return runs_; }
  /// One run of each axis, on all cores. Axes that move alike are simulated once.
  [[nodiscard]] std::vector<Simulated> simulate(const ClosedLoopRun& run,
                                                const std::vector<plant::AxisParameters>& axes) const;
  /// Every run of one axis, on all cores.
  [[nodiscard]] std::vector<Simulated> simulate(const AxisByRun& axis) const;

  /// |y - s| / |y - mean y| by channel over all runs; the scale's as what it shows beyond the encoder, over its travel.
  [[nodiscard]] Nrmse nrmse(const AxisByRun& axis) const;
  /// What would be left if this axis had made the recordings: the encoder's grid seen through the closed loop, and the
  /// sensors' own white noise. From simulating what it would have recorded.
  [[nodiscard]] Nrmse noise_floor(const AxisByRun& axis) const;

  /// Samples of runs that were simulated so far: what the questions have cost, the same on every machine.
  [[nodiscard]] std::uint64_t simulated_samples() const { return *simulated_samples_; }
  /// Are they as many as may be? What could still be asked is left out then.
  [[nodiscard]] bool spent() const { return simulated_samples() > most_samples_; }

  /// What was ruled on these runs before.
  [[nodiscard]] RulingsBefore& before() const { return *before_; }

 private:
  [[nodiscard]] Simulated simulated(const ClosedLoopRun& run, const plant::AxisParameters& axis) const;
  void simulate_alike(const ClosedLoopRun& run, const std::vector<plant::AxisParameters>& axes,
                      const std::vector<std::size_t>& alike, std::vector<Simulated>& all) const;

  const Case* data_;
  std::uint64_t most_samples_;
  double meter_share_ = 0.0;
  std::vector<ClosedLoopRun> runs_;
  std::shared_ptr<RulingsBefore> before_;
  std::shared_ptr<std::atomic<std::uint64_t>> simulated_samples_ = std::make_shared<std::atomic<std::uint64_t>>(0);
};

}  // namespace feedtwin::tools::diagnosis
