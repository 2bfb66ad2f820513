// The laws of plant/effects on recordings that another program made, each with one or two effects that its key names: with
// them switched on and the nominal numbers as given, the plant follows the recording to its noise; without them it does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "tests/support/shared_data.h"
#include "tools/recording/case.h"

namespace feedtwin::tools {
namespace {

/// Root mean squares over all runs of what the plant leaves unexplained.
struct Unexplained {
  double force_N = 0.0, stretch_m = 0.0, power_W = 0.0;
};

/// The plant under the recorded command, held to the recorded position by a spring and damper of 30 Hz: their force is what
/// the model leaves unexplained.
Unexplained unexplained(const plant::AxisParameters& axis, const Case& data) {
  constexpr double rate_per_s = 2.0 * 3.14159265358979 * 30.0;
  Unexplained sum;
  double samples = 0.0;
  auto runs = data.fit;
  runs.insert(runs.end(), data.holdout.begin(), data.holdout.end());
  for (const auto& run : runs) {
    const auto& command = run.at("torque_cmd_Nm");
    const auto& position = run.at("position_m");
    const auto& power = run.at("power_W");
    const bool scale = run.channels.contains("scale_position_m");
    plant::FeedAxis plant(axis, plant::Resolution{.sliding = 6, .settling = 6, .reversing = 12});
    plant.place(position[0]);
    constexpr double mass = 90.9;  // the same for all, so that the noise is
    double last_m = 0.0;
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const auto& shown = plant.signals();
      const double error_m = position[i] - plant.encoder().position_m(shown.encoder_counts);
      const double force_N = mass * rate_per_s * (rate_per_s * error_m + 1.4 * (error_m - last_m) / run.sample_s);
      last_m = error_m;
      if (scale) {
        const double stretch = run.at("scale_position_m")[i] - position[i];
        sum.stretch_m += std::pow(stretch - (shown.scale_position_m - shown.position_m), 2);
      }
      plant.step({command[i] + force_N / plant.model().transmission_rad_per_m}, run.sample_s);
      sum.force_N += force_N * force_N;
      sum.power_W += std::pow(power[i] - plant.signals().metered_power_W, 2);
      samples += 1.0;
    }
  }
  return {std::sqrt(sum.force_N / samples), std::sqrt(sum.stretch_m / samples), std::sqrt(sum.power_W / samples)};
}

/// The key's effects; a phase, which no key gives, is searched for.
plant::AxisParameters with_key(const Case& data, const std::string& key_file) {
  std::ifstream in(key_file);
  const auto key = nlohmann::json::parse(in);
  plant::AxisParameters axis = data.axis;
  for (const auto& [id, numbers] : key.at("effects").items()) {
    const auto* entry = plant::find_effect(id);
    if (entry == nullptr) throw std::runtime_error("no effect " + id);
    auto setting = plant::preset_of(*entry);
    for (const auto& [name, value] : numbers.items()) {
      double* place = plant::value_in(setting, *entry, name);
      if (place == nullptr) throw std::runtime_error(id + " has no " + name);
      *place = value.get<double>();
    }
    axis.effects.push_back(setting);
    double* phase = plant::value_in(axis.effects.back(), *entry, "phase_rad");
    if (phase == nullptr) continue;
    double best = 0.0, width = 0.8;
    for (double least = 1e9, centre = 0.0; width > 0.01; width *= 0.25, centre = best) {
      for (int i = -4; i <= 4; ++i) {
        *phase = std::clamp(centre + i * width, -6.28, 6.28);
        const double left_N = unexplained(axis, data).force_N;
        if (left_N < least) {
          least = left_N;
          best = *phase;
        }
      }
    }
    *phase = best;
  }
  return axis;
}

struct Gain {
  Unexplained without, with;
};
Gain gain_of(const std::string& name) {
  const Case data = read_case(tests::shared_path("practice/" + name));
  return {unexplained(data.axis, data),
          unexplained(with_key(data, tests::shared_path("practice/" + name + ".key.json")), data)};
}

constexpr double left_by_none_N = 1.6;  ///< what the case without an effect leaves: 1.35 N, from the encoder's counts

TEST(EffectsInPracticeCases, ExplainTheForceToItsNoise) {
  FEEDTWIN_NEEDS_SHARED("practice");
  for (const char* name : {"p03", "p05", "p07", "p08", "p09", "p10"}) {
    const Gain gain = gain_of(name);
    EXPECT_LT(gain.with.force_N, left_by_none_N) << name;
    EXPECT_GT(gain.without.force_N, 3.0 * left_by_none_N) << name << " shows nothing to explain";
  }
}

TEST(EffectsInPracticeCases, BacklashExplainsTheScale) {
  FEEDTWIN_NEEDS_SHARED("practice");
  const Gain gain = gain_of("p04");
  EXPECT_LT(gain.with.stretch_m, 0.06e-6) << "the grids of encoder and scale are 76 and 10 nm";
  EXPECT_GT(gain.without.stretch_m, 2e-6);
}

TEST(EffectsInPracticeCases, CopperLossExplainsThePower) {
  FEEDTWIN_NEEDS_SHARED("practice");
  const Gain gain = gain_of("p06");
  EXPECT_LT(gain.with.power_W, 0.09) << "the case without an effect leaves 0.07 W";
  EXPECT_GT(gain.without.power_W, 0.25);
}

}  // namespace
}  // namespace feedtwin::tools
