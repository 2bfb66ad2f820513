// How the motor's friction sets in at a reversal is not in Eq. 1: a torque sensor that shows it another way must move
// neither what the runs are held to be worth nor any number.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/likelihood.h"
#include "tools/diagnose/forward/polish.h"
#include "tools/identify/sliding.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double shown_otherwise_Nm = 0.02;

/// A run with all sensors; the torque sensor shows something else while the axis slides, or while it does not.
struct Tampered {
  tools::Case data;
  InverseModel model;
  Fitter fitter;
  ForwardModel forward;

  explicit Tampered(double sliding_Nm, double otherwise_Nm)
      : data(made(sliding_Nm, otherwise_Nm)),
        model(make_tracks(data.fit, data.axis), data.axis),
        fitter(model, data.axis),
        forward(data.fit, data) {}

  static tools::Case made(double sliding_Nm, double otherwise_Nm) {
    tools::Case data = tests::short_case(plant::source_axis(), plant::source_axis());
    tests::MadeRun run{.duration_s = 2.0, .torque_noise_Nm = 5e-4, .force_noise_N = 0.05};
    run.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08};
    data.fit = {tests::make_recording(plant::source_axis(), run)};
    auto& recording = data.fit.front();
    const auto slides = tools::rows_of_surely_sliding(recording.at("position_m"), recording.sample_s);
    auto& sensor = recording.channels.at("torque_sensor_Nm");
    const auto& position = recording.channels.at("position_m");
    for (std::size_t k = 1; k < sensor.size(); ++k)
      sensor[k] += std::copysign(slides[k] ? sliding_Nm : otherwise_Nm, position[k] - position[k - 1]);
    return data;
  }
  [[nodiscard]] double nats() const { return likelihood(forward, extended({data.axis, {}})).total(); }
  /// All numbers as polished.
  [[nodiscard]] std::vector<double> numbers() const {
    const auto polished = polish(forward, fitter, {data.axis, {}});
    std::vector<double> values;
    for (const auto& parameter : fitter.base()) values.push_back(value_of(parameter, polished.model.axis));
    return values;
  }
};

TEST(TorqueSensor, BeforeTheMotorSlidesMovesNeitherLikelihoodNorNumbers) {
  const Tampered as_made(0.0, 0.0), otherwise(0.0, shown_otherwise_Nm), sliding(shown_otherwise_Nm, 0.0);
  EXPECT_DOUBLE_EQ(otherwise.nats(), as_made.nats());
  EXPECT_LT(sliding.nats(), as_made.nats() - 100.0);
  EXPECT_EQ(otherwise.numbers(), as_made.numbers());
  EXPECT_NE(sliding.numbers(), as_made.numbers());
}

}  // namespace
}  // namespace feedtwin
