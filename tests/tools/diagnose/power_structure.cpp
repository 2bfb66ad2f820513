// How noisy a power meter is, where the model's power is wrong.

#include "tools/diagnose/power_structure.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_case.h"
#include "tools/diagnose/screen.h"
#include "tools/recording/power_meter.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double noise_W = 0.004;

/// Two runs of an axis with one effect; its meter is noisy.
std::vector<tools::Recording> runs_with(const plant::EffectSetting& effect) {
  auto truth = plant::source_axis();
  truth.effects.push_back(effect);
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "s_curve"}) {
    tests::MadeRun made{.motion = motion,
                        .duration_s = 8.0,
                        .torque_noise_Nm = 5e-4,
                        .force_noise_N = 0.05,
                        .power_noise_W = noise_W,
                        .seed = static_cast<unsigned>(runs.size() + 1)};
    made.settings.speed_m_per_s = 0.08, made.settings.amplitude_m = 0.02;
    runs.push_back(tests::make_recording(truth, made));
  }
  for (auto& run : runs) run.meter = tools::meter_habit(runs, plant::source_axis());
  return runs;
}

struct Asked {
  double power_rms_W = 0.0, colour_W = 0.0, gain = 0.0, p_false_alarm = 1.0;
};

/// What the recalibrated model leaves of the power, what of it passes for noise, and what the effect's id would bring.
Asked ask(const plant::EffectSetting& effect, std::string_view id) {
  const auto runs = runs_with(effect);
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const Fitter fitter(model, plant::source_axis());
  Whitening whitening = fitter.colour_of(model.residual(plant::source_axis(), {}));
  const Fit fit = fitter.fit_with_colour({plant::source_axis(), {}}, whitening, 2, 6);
  Asked found;
  const std::size_t power = model.equations().size() - 1;
  double square = 0.0, count = 0.0;
  for (const auto& s : model.segments())
    if (s.equation == power)
      square += fit.residual.segment(s.start, s.size).squaredNorm(), count += static_cast<double>(s.size);
  found.power_rms_W = std::sqrt(square / count);
  found.colour_W = whitening.residual_rms(power);
  const Screen all = screen(fitter, fit, whitening);
  const auto score = std::ranges::find(all.scores, id, [](const Score& s) { return s.hypothesis->id; });
  if (score != all.scores.end()) found.gain = score->gain, found.p_false_alarm = all.p_false_alarm(score->standard);
  return found;
}

TEST(PowerStructure, AWrongTorqueConstantIsNoNoiseOfTheMeter) {
  const auto right = ask(tests::effect("torque_gain_error", {{"relative_error", 0.0}}), "torque_gain_error");
  const auto seen = ask(tests::effect("torque_gain_error", {{"relative_error", -0.05}}), "torque_gain_error");
  EXPECT_GT(seen.power_rms_W, 10.0 * noise_W) << "there is a misfit at all";
  EXPECT_LT(seen.colour_W, 0.3 * seen.power_rms_W);
  EXPECT_LT(seen.colour_W, 1.5 * right.colour_W);
  EXPECT_GT(seen.gain, 1000.0);
  EXPECT_LT(seen.p_false_alarm, 0.005);
  EXPECT_GT(right.p_false_alarm, 0.05);
}

// The electrical numbers can nearly do what an offset does to the power, at the cost of being far from nominal.
TEST(PowerStructure, WhatOnlyTheNumbersToleranceForbidsIsAskedFor) {
  const auto seen = ask(tests::effect("torque_offset", {{"offset_Nm", -0.007}}), "torque_offset");
  EXPECT_GT(seen.gain, 100.0);
  EXPECT_LT(seen.p_false_alarm, 0.005);
}

}  // namespace
}  // namespace feedtwin
