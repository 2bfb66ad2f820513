#pragma once
// What the loop steps: axes on their own, or a whole machine tool.

#include <cstddef>
#include <span>
#include <vector>

#include "io/port.h"
#include "plant/feed_axis.h"
#include "plant/realtime.h"

namespace feedtwin::rt {

class SteppedPlant {
 public:
  SteppedPlant() = default;
  SteppedPlant(const SteppedPlant&) = delete;
  SteppedPlant& operator=(const SteppedPlant&) = delete;
  virtual ~SteppedPlant() = default;

  [[nodiscard]] virtual std::size_t axes() const noexcept FEEDTWIN_REALTIME = 0;
  [[nodiscard]] virtual const plant::FeedAxis& axis(std::size_t i) const noexcept FEEDTWIN_REALTIME = 0;
  /// The force of the process on an axis as last known, for its force sensors.
  [[nodiscard]] virtual double process_force_N(std::size_t i) const noexcept FEEDTWIN_REALTIME = 0;
  /// One tick: a torque for each axis, and what a machine's controller wants besides. Wait-free.
  virtual void step(std::span<const double> torques_Nm, const io::MachineRequest& machine,
                    double tick_s) noexcept FEEDTWIN_REALTIME = 0;
};

/// Axes that know nothing of each other.
class AxesPlant final : public SteppedPlant {
 public:
  /// @param axes must outlive this
  explicit AxesPlant(std::vector<plant::FeedAxis>& axes) noexcept : axes_(axes) {}

  [[nodiscard]] std::size_t axes() const noexcept FEEDTWIN_REALTIME override { return axes_.size(); }
  [[nodiscard]] const plant::FeedAxis& axis(std::size_t i) const noexcept FEEDTWIN_REALTIME override { return axes_[i]; }
  [[nodiscard]] double process_force_N(std::size_t) const noexcept FEEDTWIN_REALTIME override { return 0.0; }
  void step(std::span<const double> torques_Nm, const io::MachineRequest&,
            double tick_s) noexcept FEEDTWIN_REALTIME override {
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].step({.torque_Nm = torques_Nm[i]}, tick_s);
  }

 private:
  std::vector<plant::FeedAxis>& axes_;
};

}  // namespace feedtwin::rt
