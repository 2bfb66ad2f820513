#include "tools/identify/inverse_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/made_case.h"
#include "tests/support/shared_data.h"
#include "tools/identify/zero_phase_filter.h"
#include "tools/recording/mat.h"

namespace feedtwin::tools {
namespace {

double gain_at(const DigitalFilter& filter, double frequency) {
  const std::complex<double> z = std::polar(1.0, -std::numbers::pi * frequency);
  std::complex<double> top = 0.0, bottom = 0.0, power = 1.0;
  for (std::size_t i = 0; i < filter.numerator.size(); ++i, power *= z) {
    top += filter.numerator[i] * power;
    bottom += filter.denominator[i] * power;
  }
  return std::abs(top / bottom);
}

TEST(ZeroPhaseFilter, HasTheDesignsOwnGains) {
  for (const int order : {2, 4, 7}) {
    EXPECT_NEAR(gain_at(butterworth(order, 0.2), 0.0), 1.0, 1e-9);
    EXPECT_NEAR(gain_at(butterworth(order, 0.2), 0.2), std::sqrt(0.5), 1e-9);
  }
  const double ripple = std::pow(10.0, -0.05 / 20.0);
  EXPECT_NEAR(gain_at(chebyshev(8, 0.05, 0.08), 0.08), ripple, 1e-6);
  for (double f = 0.0; f < 0.08; f += 0.001) {
    EXPECT_LT(gain_at(chebyshev(8, 0.05, 0.08), f), 1.0 + 1e-6) << f;
    EXPECT_GT(gain_at(chebyshev(8, 0.05, 0.08), f), ripple - 1e-6) << f;
  }
  EXPECT_LT(gain_at(chebyshev(8, 0.05, 0.08), 0.2), 1e-3);
}

TEST(ZeroPhaseFilter, LeavesStraightLinesAndTheirPhaseAlone) {
  std::vector<double> line;
  for (int i = 0; i < 500; ++i) line.push_back(3.0 - 0.02 * i);
  const auto smooth = filter_both_ways(butterworth(4, 0.2), line);
  for (std::size_t i = 0; i < line.size(); ++i) ASSERT_NEAR(smooth[i], line[i], i < 100 || i > 400 ? 2e-3 : 1e-9) << i;
  std::vector<double> wave;
  for (int i = 0; i < 2000; ++i) wave.push_back(std::sin(0.02 * i));
  const auto same = filter_both_ways(butterworth(4, 0.2), wave);
  for (std::size_t i = 200; i < 1800; ++i) ASSERT_NEAR(same[i], wave[i], 1e-5) << i;
}

// The forces of the model's own motion, asked for by its own inverse: the two engines share nothing but the bristle law.
TEST(InverseModel, AsksForTheForceThatMadeTheMotion) {
  const auto axis = plant::source_axis();
  const auto recording =
      tests::make_recording(axis, {.settings = {.amplitude_m = 0.02, .speed_m_per_s = 0.08}, .duration_s = 3.0});
  const auto motion = recorded_motion(recording, axis.axis.lead_m);
  const auto asked = decimated(inverse_force_N(axis, motion, recording.sample_s), motion.decimation);
  const auto given = decimated(motion.force_N, motion.decimation);
  double off = 0.0, all = 0.0;
  for (std::size_t i = 0; i < given.size(); ++i) off += std::pow(asked[i] - given[i], 2), all += given[i] * given[i];
  EXPECT_LT(std::sqrt(off / all), 0.015);
  const auto rigid = fit_rigid_model(motion, true);
  EXPECT_NEAR(rigid.mass_kg, 90.86, 2.0);
}

// Published for this record: Janot, Gautier, Brunot 2019.
TEST(InverseModel, ReproducesTheReferenceFitsOfEmps) {
  FEEDTWIN_NEEDS_SHARED("data/DATA_EMPS.mat");
  const double lead_m = 0.0025, to_torque = lead_m / (2.0 * std::numbers::pi);
  const double gtau = 35.150651882723;
  auto recording = recording_from(read_mat(tests::shared_path("data/DATA_EMPS.mat")),
                                  {{"time_s", {"t"}}, {"torque_cmd_Nm", {"vir", gtau * to_torque}}, {"position_m", {"qm"}}});
  recording.sample_s = 1e-3;
  const auto motion = recorded_motion(recording, lead_m, {.held_command = false});
  EXPECT_EQ(motion.decimation, 10);
  const auto symmetric = fit_rigid_model(motion, false);
  EXPECT_NEAR(symmetric.mass_kg, 95.109, 0.001);
  EXPECT_NEAR(symmetric.viscous_pos_Ns_per_m, 203.50, 0.01);
  EXPECT_NEAR(symmetric.coulomb_N, 20.394, 0.001);
  EXPECT_NEAR(symmetric.offset_N, -3.165, 0.001);
  EXPECT_NEAR(100.0 * symmetric.relative_error, 4.083, 0.001);
  const auto directional = fit_rigid_model(motion, true);
  EXPECT_NEAR(directional.viscous_pos_Ns_per_m, 166.7, 0.1);
  EXPECT_NEAR(directional.viscous_neg_Ns_per_m, 240.4, 0.1);
  EXPECT_NEAR(100.0 * directional.relative_error, 3.112, 0.001);
}

}  // namespace
}  // namespace feedtwin::tools
