// What the encoder shows before it counts, with all that may be wrong with it.

#include <gtest/gtest.h>

#include <cmath>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"

namespace feedtwin::plant {
namespace {

EffectSetting setting(std::string_view id, std::string_view parameter, double value) {
  const auto& entry = *find_effect(id);
  auto made = preset_of(entry);
  *value_in(made, entry, parameter) = value;
  return made;
}

TEST(ShownPosition, IsWithinOneCountOfTheCountsWhateverIsWrongWithTheEncoder) {
  for (const auto& wrong : {setting("encoder_eccentricity", "amplitude_m", 5e-6),
                            setting("count_loss", "counts_per_pass", 37.0), setting("wrong_lead", "factor", 1.1)}) {
    auto parameters = source_axis();
    parameters.effects = {wrong};
    FeedAxis axis(parameters);
    double farthest_m = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const auto& signals = axis.step({.torque_Nm = 0.2 * std::sin(2e-3 * k)}, 1e-3);
      const double counted_m = axis.encoder().position_m(signals.encoder_counts);
      EXPECT_NEAR(axis.shown_position_m(), counted_m, axis.encoder().resolution_m()) << wrong.id << " at tick " << k;
      farthest_m = std::max(farthest_m, std::abs(axis.shown_position_m() - signals.position_m));
    }
    EXPECT_GT(farthest_m, 1e-6) << wrong.id << " must show";
  }
}

}  // namespace
}  // namespace feedtwin::plant
