// Properties that every registered effect has, over random settings and motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "plant/effects/registry.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/support/any_effect.h"
#include "tests/support/tick.h"
#include "tests/support/typical_effects.h"

namespace feedtwin::plant {
namespace {

using test::any_setting;
using test::shown;
using test::tick_s;

std::set<std::string> words(std::string_view text) {
  std::istringstream in{std::string(text)};
  return {std::istream_iterator<std::string>(in), {}};
}

/// A random command: noise, steps and dwells, up to the drive's limit; cutting now and then.
class AnyCommand {
 public:
  explicit AnyCommand(unsigned seed) : random_(seed) {}
  AxisCommand next() {
    if (left_-- <= 0) {
      left_ = std::uniform_int_distribution<int>(1, 120)(random_);
      level_ = std::uniform_real_distribution<double>(-0.6, 0.6)(random_);
      if (random_() % 4 == 0) level_ = 0.0;
      cutting_ = random_() % 8 == 0 ? std::uniform_real_distribution<double>(-80.0, 80.0)(random_) : 0.0;
    }
    return {level_ + std::uniform_real_distribution<double>(-0.02, 0.02)(random_), cutting_};
  }

 private:
  std::mt19937 random_;
  int left_ = 0;
  double level_ = 0.0, cutting_ = 0.0;
};

bool all_finite(const FeedAxis& axis, const AxisCommand& command) {
  const auto& s = axis.signals();
  const auto f = axis.force_sensors(command);
  const auto e = axis.energy();
  for (const double value : {s.position_m, s.scale_position_m, s.velocity_m_per_s, s.torque_Nm, s.power_W, s.metered_power_W,
                             f.torque_sensor_Nm, f.force_sensor_N, axis.table_position_m(), e.motor_electrical_J,
                             e.motor_mechanical_J, e.ball_screw_J, e.guide_J, e.load_J, e.lost_J, e.stored_J}) {
    if (!std::isfinite(value)) return false;
  }
  return true;
}

AxisParameters parameters_with(std::vector<EffectSetting> effects) {
  AxisParameters p = source_axis();
  p.effects = std::move(effects);
  return p;
}

/// What may stay open of the energy balance.
struct Open {
  double share, absolute_J;
};
constexpr Open open_at_typical{2e-5, 1e-5};
constexpr Open open_at_extremes{1e-3, 5e-3};
constexpr Open not_asked{1e300, 1e300};

/// Runs and checks what must hold for any effect; empty: it held. The energy balance is asked of motions that an axis can
/// have: at the ends of the ranges a force of 100 kN throws it through its end stops. What stays open is left by the
/// integrator's zero crossings (a velocity that is set to zero), more of them the stiffer the effect.
std::string fault_of(const AxisParameters& parameters, unsigned seed, int ticks, double tick, Open balance) {
  constexpr double sane_m_per_s = 2.0;
  constexpr double sane_m_per_s2 = 100.0;
  FeedAxis axis(parameters);
  AnyCommand commands(seed);
  bool sane = true;
  double last_v = 0.0;
  for (int i = 0; i < ticks; ++i) {
    const AxisCommand command = commands.next();
    axis.step(command, tick);
    if (!all_finite(axis, command)) return "not finite at tick " + std::to_string(i);
    const double v = axis.signals().velocity_m_per_s;
    sane = sane && std::abs(v) < sane_m_per_s && std::abs(v - last_v) < sane_m_per_s2 * tick;
    last_v = v;
    const auto e = axis.energy();
    if (sane && e.balance_error() * e.throughput_J > balance.share * e.throughput_J + balance.absolute_J) {
      std::ostringstream out;
      out << "energy balance open by " << e.balance_error() << " of " << e.throughput_J << " J at tick " << i;
      return out.str();
    }
  }
  return {};
}

TEST(EveryEffect, RunsAtTheExtremesOfItsRangeWithItsEnergyBalanceClosed) {
  for (const auto& entry : effect_registry()) {
    for (unsigned seed = 0; seed < 24; ++seed) {
      std::mt19937 random(seed);
      const auto setting = any_setting(entry, random);
      const double tick = seed % 3 == 0 ? 2.5e-4 : tick_s;
      ASSERT_EQ(fault_of(parameters_with({setting}), seed, 600, tick, open_at_extremes), "")
          << shown(setting) << ", seed " << seed;
    }
    ASSERT_EQ(fault_of(parameters_with({test::typical_effect(entry)}), 5, 3000, tick_s, open_at_typical), "") << entry.id;
  }
}

TEST(EveryEffect, RunsTogetherWithAllOthers) {
  for (unsigned seed = 0; seed < 120; ++seed) {
    std::mt19937 random(seed);
    std::vector<EffectSetting> effects;
    std::string text;
    for (const auto& entry : effect_registry()) {
      if (seed % 4 >= 2 && random() % 2 == 0) continue;
      effects.push_back(seed % 2 == 0 ? test::typical_effect(entry) : any_setting(entry, random));
      text += shown(effects.back()) + '\n';
    }
    ASSERT_EQ(fault_of(parameters_with(effects), seed, 400, tick_s, seed % 2 == 0 ? open_at_typical : not_asked), "")
        << text << "seed " << seed;
  }
}

TEST(EveryEffect, IsGoneAtItsNeutralValue) {
  for (const auto& entry : effect_registry()) {
    if (std::ranges::any_of(entry.parameters, &EffectParameter::list)) continue;  // an empty table is refused
    auto setting = preset_of(entry);
    std::size_t place = 0;
    for (const auto& p : entry.parameters) {
      if (p.neutral) setting.values[place] = *p.neutral;
      ++place;
    }
    const Resolution fine{
        .sliding = 6, .settling = 6, .reversing = 12};  // the same sub-steps with and without, whatever the effect asks for
    FeedAxis with(parameters_with({setting}), fine);
    FeedAxis without(source_axis(), fine);
    AnyCommand commands(7);
    // a stiff coupling is never quite rigid, and an extra factor of one rounds
    const double within_m = entry.hooks.join ? 1e-9 : 0.0;
    for (int i = 0; i < 2000; ++i) {
      const AxisCommand command = commands.next();
      const auto& a = with.step(command, tick_s);
      const auto& b = without.step(command, tick_s);
      ASSERT_NEAR(a.position_m, b.position_m, within_m) << entry.id << ", tick " << i;
      ASSERT_NEAR(a.scale_position_m, b.scale_position_m, within_m) << entry.id << ", tick " << i;
      ASSERT_EQ(a.encoder_counts, b.encoder_counts) << entry.id << ", tick " << i;
      ASSERT_NEAR(a.power_W, b.power_W, entry.hooks.join ? 1e-3 : 0.0) << entry.id << ", tick " << i;
    }
  }
}

TEST(EveryEffect, ChangesWhatIsSeenAtATypicalStrength) {
  for (const auto& entry : effect_registry()) {
    FeedAxis with(parameters_with({test::typical_effect(entry)}));
    FeedAxis without(source_axis());
    AnyCommand commands(3);
    bool differs = false;
    for (int i = 0; i < 2000 && !differs; ++i) {
      const AxisCommand command = commands.next();
      const auto f = with.force_sensors(command);
      const auto g = without.force_sensors(command);
      const auto& a = with.step(command, tick_s);
      const auto& b = without.step(command, tick_s);
      differs =
          std::abs(a.encoder_counts - b.encoder_counts) > 1 || std::abs(a.scale_position_m - b.scale_position_m) > 1e-7 ||
          std::abs(a.metered_power_W - b.metered_power_W) > 0.02 ||
          std::abs(f.torque_sensor_Nm - g.torque_sensor_Nm) > 1e-3 || std::abs(f.force_sensor_N - g.force_sensor_N) > 0.5;
    }
    EXPECT_TRUE(differs) << entry.id << " does nothing that a sensor sees";
  }
}

TEST(EveryEffect, NeverGivesBackMoreThanItTook) {
  for (const auto& entry : effect_registry()) {
    if (entry.work != EffectWork::dissipates && entry.work != EffectWork::alters_friction) continue;
    for (unsigned seed = 0; seed < 12; ++seed) {
      std::mt19937 random(seed);
      const auto setting = any_setting(entry, random);
      FeedAxis axis(parameters_with({setting}));
      AnyCommand commands(seed);
      double highest_J = 0.0;
      for (int i = 0; i < 2000; ++i) {
        axis.step(commands.next(), tick_s);
        const auto e = axis.energy();
        ASSERT_GE(e.lost_J, highest_J - 1e-4 * e.throughput_J - 1e-9)
            << shown(setting) << ", seed " << seed << ", tick " << i;
        highest_J = std::max(highest_J, e.lost_J);
      }
    }
  }
}

TEST(EveryEffect, HasAllItsTexts) {
  const std::set<std::string> channels{"torque_cmd_Nm",  "position_m", "scale_position_m", "torque_sensor_Nm",
                                       "force_sensor_N", "power_W",    "reference_m",      "temperature_C"};
  std::set<std::string_view> seen;
  for (const auto& entry : effect_registry()) {
    EXPECT_TRUE(seen.insert(entry.id).second) << entry.id << " twice";
    EXPECT_EQ(find_effect(entry.id), &entry);
    EXPECT_FALSE(entry.meaning.empty()) << entry.id;
    EXPECT_EQ(entry.meaning.find('\n'), std::string_view::npos) << entry.id;
    EXPECT_FALSE(entry.exciting_move.empty()) << entry.id;
    EXPECT_FALSE(name_of(entry.component).empty()) << entry.id;
    EXPECT_TRUE(entry.make != nullptr || entry.adapt != nullptr) << entry.id << " runs nothing";
    EXPECT_FALSE(words(entry.channels).empty()) << entry.id;
    for (const auto& channel : words(entry.channels)) EXPECT_TRUE(channels.contains(channel)) << entry.id << ": " << channel;
    EXPECT_TRUE(!words(entry.confused_with).empty() || entry.id == "learned_residual") << entry.id;
    for (const auto& other : words(entry.confused_with)) {
      EXPECT_NE(find_effect(other), nullptr) << entry.id << ": " << other;
      EXPECT_NE(other, entry.id);
    }
    bool strength = false;
    for (const auto& p : entry.parameters) {
      EXPECT_FALSE(p.name.empty() || p.unit.empty() || p.meaning.empty()) << entry.id << "." << p.name;
      EXPECT_LT(p.lowest, p.highest) << entry.id << "." << p.name;
      for (const auto& value : {p.preset, p.neutral}) {
        EXPECT_TRUE(!value || (p.lowest <= *value && *value <= p.highest)) << entry.id << "." << p.name;
      }
      strength = strength || p.neutral.has_value() || p.list;
    }
    EXPECT_TRUE(strength) << entry.id << " has no parameter whose neutral value switches it off";
  }
}

TEST(EveryEffect, OfTheContractIsRegistered) {
  for (const auto* id : {"direction_dependent_friction",
                         "sublinear_viscous",
                         "presliding_memory",
                         "dwell_breakaway",
                         "frictional_lag",
                         "thermal_friction",
                         "friction_drift",
                         "position_friction",
                         "local_friction",
                         "load_dependent_friction",
                         "cable_spring",
                         "backlash",
                         "screw_compliance",
                         "lead_error",
                         "cyclic_lead_error",
                         "screw_growth",
                         "rev_ripple",
                         "cogging",
                         "torque_ripple",
                         "current_loop_lag",
                         "input_delay",
                         "torque_gain_error",
                         "torque_saturation",
                         "torque_offset",
                         "payload",
                         "gravity",
                         "quadratic_drag",
                         "floor_vibration",
                         "process_force",
                         "hard_stop",
                         "copper_loss",
                         "regeneration_clipped",
                         "power_meter_window",
                         "encoder_eccentricity",
                         "count_loss",
                         "sensor_gain",
                         "channel_skew",
                         "wrong_lead",
                         "wrong_sign",
                         "hidden_friction_compensation"}) {
    EXPECT_NE(find_effect(id), nullptr) << id;
  }
}

TEST(EveryEffect, IsRefusedWhenItsSettingDoesNotFit) {
  EXPECT_THROW(FeedAxis(parameters_with({{"warp_drive", {1.0}, {}}})), std::invalid_argument);
  EXPECT_THROW(FeedAxis(parameters_with({{"cogging", {1.0}, {}}})), std::invalid_argument);
  EXPECT_THROW(FeedAxis(parameters_with({{"learned_residual", {}, {{1.0}, {1.0}, {}, {1.0}, {}, {}, {}}}})),
               std::invalid_argument);
}

}  // namespace
}  // namespace feedtwin::plant
