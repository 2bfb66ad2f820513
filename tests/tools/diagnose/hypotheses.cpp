// Every hypothesis of the registry against the plant: with its effect switched on in closed loop, fitted alone, it comes
// back with the sign and the numbers that the plant was given. The nominal numbers float, but where they can nearly do what
// the effect does: those laws are asked with the numbers known.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "plant/effects/registry.h"
#include "tests/support/made_case.h"
#include "tools/diagnose/fit.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct Trial {
  std::vector<std::pair<std::string_view, double>> truth;  ///< of the plant
  std::vector<double> start;                               ///< working parameters: amplitudes at 0, shapes about the truth
  double tolerance = 0.03;
  bool sensors = true;  ///< of torque and force; false: where the plant simplifies what they see
  bool known_numbers = false;
};

const std::map<std::string_view, Trial>& trials() {
  static const std::map<std::string_view, Trial> all{
      {"cogging", {{{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}, {"phase_rad", 0.7}}, {0, 0, 8}}},
      {"torque_ripple", {{{"relative_amplitude", 0.05}, {"cycles_per_rev", 6.0}, {"phase_rad", -1.1}}, {0, 0, 6}}},
      {"rev_ripple",
       {{{"amplitude_N", 5.0}, {"cycles_per_rev", 3.37}, {"phase_rad", 2.0}}, {0, 0, 0, 0, 0, 0, 0, 0, 3.375}}},
      {"rev_ripple_of_friction", {{{"amplitude_N", 9.0}, {"cycles_per_rev", 2.37}}, {0, 0, 0, 0, 0, 0, 0, 0, 2.375}, 0.05}},
      {"backlash", {{{"gap_m", 6e-6}}, {0, 0, std::log(2e3)}, 0.06}},  // the flank swings: a start for the closed loop
      {"screw_compliance", {{{"stiffness_N_per_m", 3e7}}, {0, std::log(2e3)}}},
      {"position_friction",
       {{{"relative_slope_per_half_stroke", -0.4},
         {"viscous_slope_forth_Ns_per_m", 300.0},
         {"viscous_slope_back_Ns_per_m", -200.0}},
        {0, 0, 0}}},
      {"position_friction_wave",
       {{{"relative_amplitude", 0.3}, {"period_m", 0.02}, {"phase_rad", 0.7}}, {0, 0, 0, 0, 0.021}}},
      {"copper_loss", {{{"coefficient_W_per_Nm2", 15.0}}, {0}, 0.06, true, true}},
      {"payload", {{{"mass_kg", 3.0}}, {0}, 0.03, true, true}},
      {"cable_spring", {{{"stiffness_N_per_m", 500.0}, {"neutral_m", 0.006}}, {0, 0}}},
      {"current_loop_lag", {{{"time_constant_s", 2e-3}}, {0}}},
      {"input_delay", {{{"delay_s", 2e-3}}, {0}}},
      {"thermal_friction", {{{"viscous_reduction", 0.3}, {"energy_scale_J", 6.0}}, {0, 5, 0, 0, 0, 0}}},
      {"thermal_friction_of_all", {{{"reduction", 0.2}, {"energy_scale_J", 6.0}}, {0, 5, 0, 0, 0, 0}}},
      {"friction_drift", {{{"relative_change", -0.3}, {"time_constant_s", 1.2}}, {0, 1, 0, 0, 0, 0}}},
      {"torque_gain_error", {{{"relative_error", -0.1}}, {0}, 0.03, true, true}},
      {"torque_offset", {{{"offset_Nm", 0.012}}, {0}, 0.03, true, true}},
      {"gravity", {{{"force_N", -15.0}}, {0}, 0.03, true, true}},
      {"quadratic_drag", {{{"coefficient_Ns2_per_m2", 3000.0}}, {0}}},
      {"sublinear_viscous", {{{"exponent", 0.7}}, {0}}},
      {"direction_dependent_friction",
       {{{"coulomb_difference_N", 12.0}, {"viscous_difference_Ns_per_m", -300.0}}, {0, 0}, 0.03, true, true}},
      {"lead_error", {{{"relative_error", -1e-4}}, {0, 0}}},
      {"cyclic_lead_error", {{{"amplitude_m", 2e-6}, {"cycles_per_rev", 1.0}, {"phase_rad", 0.7}}, {0, 0, 1}}},
      {"encoder_eccentricity", {{{"amplitude_m", 6e-6}, {"cycles_per_rev", 2.0}, {"phase_rad", 0.7}}, {0, 0, 2}}},
      {"frictional_lag", {{{"time_constant_s", 0.012}}, {0}, 0.07, false}},
      {"frictional_lag_of_velocity", {{{"time_constant_s", 0.012}}, {0}, 0.07, false}},
      {"local_friction",
       {{{"height_N", 15.0}, {"centre_m", 0.004}, {"half_width_m", 0.002}, {"on_screw", 1.0}}, {0, 0.0038, 0.002, 1}, 0.08}},
      {"dwell_breakaway", {{{"relative_rise", 0.4}, {"time_constant_s", 0.06}}, {0, 20.0, 0}, 0.25}},
      {"regeneration_clipped", {{{"share", 1.0}}, {0}}},
      {"sensor_gain", {{{"torque_sensor_gain", 1.1}, {"force_sensor_gain", 1.0}}, {0, 0, 0}, 0.03, true, true}},
      {"channel_skew", {{{"torque_sensor_delay_s", 3e-3}, {"force_sensor_delay_s", 2e-3}}, {0, 0}}},
      {"torque_saturation", {{{"limit_Nm", 0.7}}, {0, 0.68 * 400.0 * std::numbers::pi}}},
      {"floor_vibration", {{{"acceleration_m_per_s2", 2.0}, {"frequency_Hz", 17.03}}, {0, 0, 0, 0, 0, 0, 0, 0, 17.0}}},
      {"hidden_friction_compensation", {{{"torque_Nm", 0.02}, {"speed_m_per_s", 1e-3}}, {0, 1e-3, 0, 1}, 0.06, true, true}},
      {"process_force", {{{"amplitude_N", 8.0}, {"frequency_Hz", 60.04}}, {0, 0, 0, 0, 0, 0, 0, 0, 60.0}}},
      {"process_force_against_motion",
       {{{"opposing_N", 6.0}, {"amplitude_N", 8.0}, {"frequency_Hz", 60.04}},
        {0, 0, 0, 0, 0, 0, 0, 0, 60.0, 0, -1.0, 1.0},
        0.03,
        true,
        true}},
      {"hard_stop",
       {{{"position_m", 0.0194}, {"direction", 1.0}, {"stiffness_N_per_m", 3e5}, {"damping_Ns_per_m", 2000.0}},
        {0, 0, 0.0193, 1}}},
      {"count_loss", {{{"counts_per_pass", 60.0}, {"angle_rad", 2.0}}, {0, 2.1}}},
      {"screw_growth",
       {{{"relative_growth", 1e-4}, {"time_constant_s", 1.5}, {"fixed_end_m", -0.1}}, {0, 2, -0.06, 0, 0, 0, 0}}},
      {"load_dependent_friction", {{{"friction_per_load", 0.3}, {"guide_friction_share", 1.0}}, {0, 1}}},
      {"presliding_memory", {{{"force_N", 80.0}, {"distance_m", 2e-5}}, {0, 3e-5}}},
  };
  return all;
}

/// Fast and jerky, and slow over a longer way with rests at its ends. Power only for what acts there: its equation takes the
/// commanded torque for the one that is there.
std::vector<tools::Recording> runs_of(const plant::AxisParameters& truth, bool sensors, bool power) {
  const auto run = [&](const char* motion, const controllers::MotionSettings& settings, unsigned seed) {
    auto made = tests::make_recording(truth, {.motion = motion,
                                              .settings = settings,
                                              .duration_s = 2.0,
                                              .sensors = sensors,
                                              .scale_at_table = true,
                                              .torque_noise_Nm = 5e-4,
                                              .force_noise_N = 0.05,
                                              .seed = seed});
    if (!power) made.channels.erase("power_W");
    return made;
  };
  return {run("sine", {.amplitude_m = 0.02, .speed_m_per_s = 0.11}, 1), run("s_curve",
                                                                            {.amplitude_m = 0.012,
                                                                             .speed_m_per_s = 0.06,
                                                                             .acceleration_m_per_s2 = 8.0,
                                                                             .jerk_m_per_s3 = 800.0,
                                                                             .dwell_s = 0.15},
                                                                            2)};
}

plant::EffectSetting setting_of(std::string_view id, const Trial& trial) {
  const auto* entry = plant::find_effect(id);
  auto setting = plant::preset_of(*entry);
  for (const auto& [name, value] : trial.truth) *plant::value_in(setting, *entry, name) = value;
  return setting;
}

class EveryHypothesis : public testing::TestWithParam<std::string_view> {};

/// The noise's own colour, from the same runs without any effect.
const Whitening& whitening_of(bool sensors, bool power) {
  static std::map<std::pair<bool, bool>, Whitening> made;
  const auto found = made.find({sensors, power});
  if (found != made.end()) return found->second;
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks(runs_of(axis, sensors, power), axis), axis);
  return made.emplace(std::pair{sensors, power}, Whitening::estimate(model, model.residual(axis, {}))).first->second;
}

/// Gauss-Newton on the effect's own numbers alone.
Candidate fit_alone(const InverseModel& model, const Whitening& whitening, Candidate at) {
  auto& q = at.effects[0].q;
  const auto& parameters = at.effects[0].hypothesis->parameters;
  const auto left = [&] { return whitening.applied(model, model.residual(at.axis, at.effects)); };
  for (int iteration = 0; iteration < 5; ++iteration) {
    const Vector now = left();
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(now.size(), static_cast<Index>(q.size()));
    for (std::size_t j = 0; j < q.size(); ++j) {
      if (!fitted(parameters[j].kind)) continue;
      const double kept = q[j];
      q[j] += parameters[j].step;
      slope.col(static_cast<Index>(j)) = (left() - now) / parameters[j].step;
      q[j] = kept;
    }
    const Eigen::VectorXd step = slope.colPivHouseholderQr().solve(-now);
    for (std::size_t j = 0; j < q.size(); ++j)
      q[j] = std::clamp(q[j] + step[static_cast<Index>(j)], parameters[j].lowest, parameters[j].highest);
  }
  return at;
}

TEST_P(EveryHypothesis, ComesBackFromThePlantWithSignAndNumbers) {
  ASSERT_TRUE(trials().contains(GetParam())) << "no trial of this hypothesis";
  const Trial& trial = trials().at(GetParam());
  ASSERT_LE(trial.start.size(), hypothesis(GetParam()).parameters.size());
  auto truth = plant::source_axis(), nominal = truth;
  truth.effects.push_back(setting_of(GetParam(), trial));
  if (!trial.known_numbers) {
    nominal.motor.inertia_kgm2 *= 1.03;
    nominal.ball_screw.viscous_Ns_per_m.neg *= 0.97;
  }
  const bool power = hypothesis(GetParam()).channel == "power_W";
  const InverseModel model(make_tracks(runs_of(truth, trial.sensors, power), nominal), nominal);
  Candidate start{nominal, {{&hypothesis(GetParam()), trial.start}}};
  start.effects[0].q.resize(hypothesis(GetParam()).parameters.size(), 0.0);  // of windows there are many: none
  const Whitening& whitening = whitening_of(trial.sensors, power);
  const Candidate fitted =
      trial.known_numbers ? fit_alone(model, whitening, start) : Fitter(model, nominal).fit(start, whitening, 10).model;
  const auto found = fitted.effects[0].hypothesis->named(fitted.effects[0].q, fitted.axis);
  for (const auto& [name, value] : trial.truth) {
    const auto own = std::ranges::find(found, name, &NamedValue::name);
    if (own == found.end()) continue;  // a number that the hypothesis leaves at its preset
    const double allowed = name.ends_with("_rad") ? 0.06 : trial.tolerance * std::abs(value);
    EXPECT_NEAR(own->value, value, allowed) << name;
  }
}

// M_L a and the weight change sign apart, so that the load of the one alone is another law.
TEST(LoadDependentFriction, RisesWithTheWeightAsWellAsWithTheMass) {
  constexpr double weight_N = -10.0, per_load = 0.35;
  const auto nominal = plant::source_axis();
  auto truth = nominal;
  truth.effects = {tests::effect("gravity", {{"force_N", weight_N}}),
                   tests::effect("load_dependent_friction", {{"friction_per_load", per_load}})};
  const InverseModel model(make_tracks(runs_of(truth, true, false), nominal), nominal);
  const Candidate start{nominal, {{&hypothesis("gravity"), {0.0}}, {&hypothesis("load_dependent_friction"), {0.0, 0.0}}}};
  const Candidate fitted = Fitter(model, nominal).fit(start, whitening_of(true, false), 10).model;
  EXPECT_NEAR(fitted.effects[0].q[0], weight_N, 0.03 * std::abs(weight_N));
  EXPECT_NEAR(fitted.effects[1].q[0], per_load, 0.03 * per_load);
}

TEST(LocalFriction, IsToldWhereItIs) {
  const auto& spot = hypothesis("local_friction");
  EXPECT_EQ(component_of({&spot, {15.0, 0.004, 0.002, 0.0}}, plant::source_axis()), "guide");
  EXPECT_EQ(component_of({&spot, {15.0, 0.004, 0.002, 1.0}}, plant::source_axis()), "ball_screw");
  EXPECT_EQ(component_of({&hypothesis("cogging"), {0.01, 0.0, 8.0}}, plant::source_axis()), "motor");
}

// A force sensor at the table feels a spot on the guide and none on the screw: both are asked for where there is one.
TEST(LocalFriction, IsFoundOnTheScrewWhereAForceSensorTells) {
  const auto nominal = plant::source_axis();
  auto truth = nominal;
  for (const double on_screw : {0.0, 1.0}) {
    truth.effects = {tests::effect(
        "local_friction", {{"height_N", 12.0}, {"centre_m", 0.004}, {"half_width_m", 0.003}, {"on_screw", on_screw}})};
    const InverseModel model(make_tracks(runs_of(truth, true, false), nominal), nominal);
    const Fitter fitter(model, nominal);
    const auto& colour = whitening_of(true, false);
    const Fit fit = fitter.fit({nominal, {}}, colour, 10);
    const auto scores = scores_of({&hypothesis("local_friction")}, fitter, fit, colour);
    ASSERT_EQ(scores.size(), 1U);
    EXPECT_EQ(scores.front().q[3], on_screw);
  }
}

// The forces do not ask a law that only scales friction: so it must not add any.
TEST(LawsOfFriction, AddForceWhereTheySaySoAndElsewhereOnlyScale) {
  const Track track = make_track(runs_of(plant::source_axis(), true, true).front(), plant::source_axis());
  Baseline base;
  base.screw_N = base.guide_N = base.motor_N = Vector::Ones(track.size);
  int only_scale = 0, force_too = 0;
  for (const auto& h : hypotheses()) {
    if (!h.friction) continue;
    auto q = trials().at(h.id).start;
    for (std::size_t i = 0; i < q.size(); ++i)
      if (h.parameters[i].kind == Kind::amplitude) q[i] = h.parameters[i].step;
    Contribution sum;
    h.apply({track, plant::source_axis(), base}, q, sum);
    EXPECT_GT(sum.screw_sliding.size() + sum.screw_viscous.size(), 0) << h.id;
    Index forces = 0;
    for (const Vector* more : {&sum.drive_N, &sum.motor_N, &sum.screw_N, &sum.guide_N, &sum.slip_m, &sum.power_W,
                               &sum.torque_sensor_N, &sum.force_sensor_N})
      forces += more->size();
    EXPECT_EQ(forces > 0, h.forces_too) << h.id;
    ++(h.forces_too ? force_too : only_scale);
  }
  EXPECT_GE(only_scale + force_too, 5);
  EXPECT_GE(only_scale, 1);
  EXPECT_GE(force_too, 1);
}

// After some turns the reading is off by more than the shaft moves in a sample: its own angle would misplace the mark.
TEST(CountLoss, TheMarkIsPassedAtTheShaftsTrueAngle) {
  constexpr double counts = 400.0, angle_rad = 2.0;
  auto axis = plant::source_axis();
  axis.effects.push_back(tests::effect("count_loss", {{"counts_per_pass", counts}, {"angle_rad", angle_rad}}));
  const tools::Recording recording = tests::make_recording(axis, {.motion = "sine",
                                                                  .settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.02},
                                                                  .duration_s = 8.0,
                                                                  .scale_at_table = true});
  const Track track = make_track(recording, plant::source_axis());
  Contribution sum;
  hypothesis("count_loss").apply({track, plant::source_axis(), Baseline{}}, std::vector{counts, angle_rad}, sum);
  const double loss_m = counts * axis.axis.lead_m / axis.axis.encoder_counts_per_rev;
  const double most_m = track.slip_m.cwiseAbs().maxCoeff();
  EXPECT_GT(most_m, 2.5 * loss_m) << "several turns";
  const Eigen::ArrayXd off_m = (track.slip_m - sum.slip_m).array().abs();
  EXPECT_LT((off_m > 0.2 * loss_m).count(), 3) << "samples in which another turn is taken";
}

// Between samples a straight line would take 3 % off this sine, and as much off any noise.
TEST(ChannelSkew, HalfASampleLaterAReadingKeepsItsStrength) {
  constexpr double per_sample = 2.0 * std::numbers::pi * 80.0 * 1e-3;
  Track track;
  track.size = 400;
  track.force_sensor_N = (per_sample * Vector::LinSpaced(track.size, 0.0, 399.0)).array().sin();
  Contribution sum;
  hypothesis("channel_skew").apply({track, plant::source_axis(), Baseline{}}, std::vector{0.0, 0.5e-3}, sum);
  const auto inside = Eigen::seq(10, track.size - 11);
  const Vector later = (track.force_sensor_N - sum.force_sensor_N)(inside);
  const Vector truth = (per_sample * (Vector::LinSpaced(track.size, 0.0, 399.0).array() + 0.5)).sin().matrix()(inside);
  EXPECT_NEAR(later.norm() / truth.norm(), 1.0, 0.005);
  EXPECT_LT((later - truth).norm(), 0.01 * truth.norm());
}

std::vector<std::string_view> ids() {
  std::vector<std::string_view> all;
  for (const auto& one : hypotheses()) all.push_back(one.id);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryHypothesis, testing::ValuesIn(ids()),
                         [](const auto& chosen) { return std::string(chosen.param); });

}  // namespace
}  // namespace feedtwin
