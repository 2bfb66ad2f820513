// A diagnosis of the real record, judged on laps that it did not see.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/support/shared_data.h"
#include "tools/diagnose/diagnosis.h"
#include "tools/identify/inverse_model.h"
#include "tools/identify/zero_phase_filter.h"
#include "tools/recording/mat.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tools::Case;

/// A lap of the real record as a run of its own.
tools::Recording lap(const tools::Recording& whole, std::size_t first, std::size_t last) {
  tools::Recording part = whole;
  for (auto& [name, values] : part.channels) {
    values = {values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(last)};
    if (name == tools::channel::time_s)
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) * whole.sample_s;
  }
  return part;
}

constexpr double lead_m = 0.0025, to_torque = lead_m / (2.0 * std::numbers::pi);

double rms(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                   static_cast<double>(values.size()));
}

tools::Recording whole_record() {
  auto whole = tools::recording_from(tools::read_mat(tests::shared_path("data/DATA_EMPS.mat")),
                                     {{"time_s", {"t"}},
                                      {"torque_cmd_Nm", {"vir", 35.150651882723 * to_torque}},
                                      {"position_m", {"qm"}},
                                      {"reference_m", {"qg"}}});
  whole.sample_s = 1e-3;
  return whole;
}

plant::AxisParameters rough_axis() {
  plant::AxisParameters axis;
  axis.axis = {.lead_m = lead_m, .stroke_m = 0.6, .torque_limit_Nm = 0.14, .encoder_counts_per_rev = 50000.0};
  axis.motor.inertia_kgm2 = 1.2e-5;
  axis.motor.damping_Nms = {1e-5, 1e-5};
  axis.motor.coulomb_N = {5.0, 5.0};
  axis.ball_screw_inertia_kgm2 = 2e-6;
  axis.ball_screw = {.coulomb_N = {12.0, 12.0},
                     .static_N = {15.0, 15.0},
                     .stribeck_m_per_s = {0.002, 0.002},
                     .viscous_Ns_per_m = {100.0, 100.0},
                     .stiffness_N_per_m = 5e6,
                     .damping_Ns_per_m = 1000.0};
  axis.guide_mass_kg = 5.0;
  axis.guide = {.coulomb_N = {5.0, 5.0},
                .static_N = {6.0, 6.0},
                .stribeck_m_per_s = {0.002, 0.002},
                .viscous_Ns_per_m = {40.0, 40.0},
                .stiffness_N_per_m = 1e6,
                .damping_Ns_per_m = 500.0};
  return axis;
}

// The published rigid model in an axis file, by two ways that follow the motion each for itself. Bristles in place of a sign
// and commands that are held leave it 3.91 % where the fit that it comes from has 4.083 %.
TEST(ForceErrorOfTheRealRecord, IsThatOfTheInverseModelOfIdentify) {
  FEEDTWIN_NEEDS_SHARED("data/DATA_EMPS.mat");
  constexpr double offset_N = -3.165;
  plant::AxisParameters axis = rough_axis();
  axis.motor.inertia_kgm2 = 95.109 * to_torque * to_torque;
  axis.ball_screw_inertia_kgm2 = 1e-12;
  axis.guide_mass_kg = 1e-6;
  axis.motor.damping_Nms = {0.0, 0.0};
  axis.motor.coulomb_N = {0.0, 0.0};
  axis.guide.coulomb_N = axis.guide.static_N = {1e-6, 1e-6};
  axis.guide.viscous_Ns_per_m = {0.0, 0.0};
  axis.ball_screw.coulomb_N = axis.ball_screw.static_N = {20.394, 20.394};
  axis.ball_screw.viscous_Ns_per_m = {203.50, 203.50};
  const auto record = whole_record();
  const auto motion = tools::recorded_motion(record, lead_m);
  auto off_N = tools::inverse_force_N(axis, motion, record.sample_s);
  for (std::size_t i = 0; i < off_N.size(); ++i) off_N[i] = motion.force_N[i] - off_N[i] - offset_N;
  const double identified =
      rms(tools::decimated(off_N, motion.decimation)) / rms(tools::decimated(motion.force_N, motion.decimation));
  const InverseModel model(make_tracks({record}, axis), axis);
  const Candidate published{axis, {{&hypothesis("torque_offset"), {-offset_N * to_torque}}}};
  const double diagnosed = relative_force_error(followed(model, published));
  fmt::print("published rigid model, relative force error below 40 Hz: {:.3f} %, by identify {:.3f} %\n", 100.0 * diagnosed,
             100.0 * identified);
  EXPECT_NEAR(diagnosed, identified, 0.001);
}

Case case_of(const std::vector<tools::Recording>& fit, const std::vector<tools::Recording>& judge) {
  Case data;
  data.axis = rough_axis();
  data.controller = controllers::CascadeGains{.position_per_s = 160.18,
                                              .velocity_Ns_per_m = 8557.426,
                                              .velocity_integral_N_per_m = 0.0,
                                              .velocity_feedforward = 0.0,
                                              .acceleration_feedforward_kg = 0.0,
                                              .torque_limit_Nm = 0.13986,
                                              .lead_m = lead_m,
                                              .velocity_window_samples = 2};
  data.fit = fit;
  data.holdout = judge;
  return data;
}

struct Errors {
  double closed_loop, recalibrated, inverse, below_40_Hz, below_40_Hz_recalibrated;
};

/// Of a diagnosis on laps that it was not fitted to, with what it names printed.
Errors errors_of(const Case& data) {
  const auto found = diagnose(data, [](std::string_view l) {
    if (std::getenv("EMPSLOG")) fmt::print(stderr, "{}\n", l);
  });
  const auto& torque = found.holdout.at("torque_cmd_Nm");
  const Errors errors{torque.after, torque.recalibrated, found.holdout_inverse.at("torque_cmd_Nm").after,
                      found.force_error.after, found.force_error.recalibrated};
  fmt::print("laps not fitted: closed loop {:.2f} % (recalibrated alone {:.2f} %), inverse model {:.3f} %\n",
             100.0 * errors.closed_loop, 100.0 * errors.recalibrated, 100.0 * errors.inverse);
  fmt::print("laps not fitted, inverse model below 40 Hz, |f - m| / |f|: {:.3f} %\n", 100.0 * errors.below_40_Hz);
  for (const auto& effect : found.effects) {
    fmt::print("{}: {}\n", effect.hypothesis->id, effect.sentence);
    for (const auto& [name, estimate] : effect.parameters) EXPECT_TRUE(std::isfinite(estimate.value)) << name;
  }
  return errors;
}

std::vector<tools::Recording> laps() {
  const auto whole = whole_record();
  return {lap(whole, 0, 6230), lap(whole, 6230, 12460), lap(whole, 12460, 18690), lap(whole, 18690, whole.size())};
}

// Laps 1 and 3 are fitted, 2 and 4 judge. Asked of the inverse model: 1.8 %, of the closed loop: 4.4 %. The published rigid
// model leaves 5.85 % of the whole record, which it was fitted to.
TEST(ForwardModel, ClosedLoopOfTheRealRecordOnLapsThatWereNotFitted) {
  FEEDTWIN_NEEDS_SHARED("data/DATA_EMPS.mat");
  const auto lap = laps();
  const Errors errors = errors_of(case_of({lap[0], lap[2]}, {lap[1], lap[3]}));
  EXPECT_LT(errors.closed_loop, 0.038);
  EXPECT_LT(errors.closed_loop, 0.85 * errors.recalibrated);
  EXPECT_LT(errors.inverse, 0.018);
  EXPECT_LT(errors.below_40_Hz, 0.0168);
  EXPECT_LT(errors.below_40_Hz, 0.7 * errors.below_40_Hz_recalibrated);
}

// The same with other laps for the fit: what is found there must not hang on which they are.
TEST(ForwardModel, OtherLapsOfTheRealRecord) {
  FEEDTWIN_NEEDS_SHARED("data/DATA_EMPS.mat");
  if (std::getenv("FEEDTWIN_ALL_TESTS") == nullptr) GTEST_SKIP() << "three more diagnoses; FEEDTWIN_ALL_TESTS=1 runs them";
  const auto lap = laps();
  for (const auto& data : {case_of({lap[1], lap[3]}, {lap[0], lap[2]}), case_of({lap[0], lap[1]}, {lap[2], lap[3]}),
                           case_of({lap[2], lap[3]}, {lap[0], lap[1]})}) {
    const Errors errors = errors_of(data);
    EXPECT_LT(errors.closed_loop, 0.044);
    EXPECT_LT(errors.inverse, 0.019);
  }
}

}  // namespace
}  // namespace feedtwin
