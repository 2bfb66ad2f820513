#include "plant/machine/milling_force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace feedtwin::plant {
namespace {

using std::numbers::pi;

/// Aluminium 7075-T6, dry, carbide: Chin. J. Mech. Eng. 34 (2021), doi 10.1186/s10033-021-00536-9, table 5, its ref. 190.
constexpr CuttingCoefficients aluminium{767.01e6, 168.8e6, 222.0e6, 27.7e3, 26.6e3, 0.7e3};

MillingLoad mean_over_turns(const MillingForce& milling, double dx, double dy, const Engagement& e, int ticks, int turns = 1,
                            double direction = 1.0) {
  MillingLoad sum;
  const double turn = direction * turns * 2 * pi / ticks;
  for (int i = 0; i < ticks; ++i) {
    const auto l = milling.over(0.3 + i * turn, turn, dx, dy, e);
    sum.force_x_N += l.force_x_N / ticks;
    sum.force_y_N += l.force_y_N / ticks;
    sum.force_z_N += l.force_z_N / ticks;
    sum.torque_Nm += l.torque_Nm / ticks;
    sum.removal_rate_m3_per_s += l.removal_rate_m3_per_s / ticks;
  }
  return sum;
}

TEST(MillingForce, SlottingGivesTheClosedFormAverages) {
  // Altintas, Manufacturing Automation, 2nd ed., section 2.8.1: full immersion, N teeth, depth a, feed per tooth c
  for (const int N : {1, 2, 3, 4}) {
    for (const double c : {0.02e-3, 0.1e-3}) {
      const double a = 1.5e-3, D = 10e-3;
      const MillingForce milling({.diameter_m = D, .teeth = N}, aluminium);
      const auto mean = mean_over_turns(milling, c, 0, slot(a), 97);
      const auto& k = aluminium;
      EXPECT_NEAR(mean.force_x_N / (-N * a * (k.Krc_N_per_m2 * c / 4 + k.Kre_N_per_m / pi)), 1.0, 1e-12);
      EXPECT_NEAR(mean.force_y_N / (N * a * (k.Ktc_N_per_m2 * c / 4 + k.Kte_N_per_m / pi)), 1.0, 1e-12);
      EXPECT_NEAR(mean.force_z_N / (N * a * (k.Kac_N_per_m2 * c / pi + k.Kae_N_per_m / 2)), 1.0, 1e-12);
      EXPECT_NEAR(mean.torque_Nm / (N * a * D / (4 * pi) * (2 * k.Ktc_N_per_m2 * c + pi * k.Kte_N_per_m)), 1.0, 1e-12);
      EXPECT_NEAR(mean.removal_rate_m3_per_s / (a * D * c), 1.0, 1e-12) << "volume a tooth period";
    }
  }
}

TEST(MillingForce, AnyImmersionGivesTheClosedFormAverages) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, pi);
  const double a = 2e-3, c = 0.05e-3;
  const int N = 3;
  const MillingForce milling({.diameter_m = 8e-3, .teeth = N}, aluminium);
  for (int i = 0; i < 200; ++i) {
    double st = angle(random), ex = angle(random);
    if (st > ex) std::swap(st, ex);
    Engagement e;
    e.immersions[0] = {st, ex, a};
    e.count = 1;
    // the same book's average forces per tooth period, x and y, between the limits of phi
    const auto& k = aluminium;
    const auto fx = [&](double p) {
      return N * a * c / (8 * pi) * (k.Ktc_N_per_m2 * std::cos(2 * p) - k.Krc_N_per_m2 * (2 * p - std::sin(2 * p))) +
             N * a / (2 * pi) * (-k.Kte_N_per_m * std::sin(p) + k.Kre_N_per_m * std::cos(p));
    };
    const auto fy = [&](double p) {
      return N * a * c / (8 * pi) * (k.Ktc_N_per_m2 * (2 * p - std::sin(2 * p)) + k.Krc_N_per_m2 * std::cos(2 * p)) -
             N * a / (2 * pi) * (k.Kte_N_per_m * std::cos(p) + k.Kre_N_per_m * std::sin(p));
    };
    const auto mean = mean_over_turns(milling, c, 0, e, 53);
    EXPECT_NEAR(mean.force_x_N, fx(ex) - fx(st), 1e-9) << st << " " << ex;
    EXPECT_NEAR(mean.force_y_N, fy(ex) - fy(st), 1e-9) << st << " " << ex;
  }
}

/// The model's equations summed up point by point, nothing integrated.
MillingLoad brute_force(const ToolParameters& tool, const CuttingCoefficients& k, double angle, double turn, double dx,
                        double dy, const Engagement& e) {
  constexpr int angles = 4000, heights = 40;
  MillingLoad sum;
  for (int n = 0; n < angles; ++n) {
    const double rho = angle + turn * (n + 0.5) / angles;
    for (int j = 0; j < tool.teeth; ++j) {
      for (int i = 0; i < e.count; ++i) {
        const auto& im = e.immersions[static_cast<std::size_t>(i)];
        for (int h = 0; h < heights; ++h) {
          const double dz = im.depth_m / heights;
          const double lag = 2 * (h + 0.5) * dz * std::tan(tool.helix_rad) / tool.diameter_m;
          // the tooth's direction in the machine's axes; clockwise seen from above
          const double theta = -(rho + j * 2 * pi / tool.teeth - lag);
          const double ex = std::cos(theta), ey = std::sin(theta);
          double phi = std::remainder(pi / 2 + e.heading_rad - theta, 2 * pi);
          if (phi < im.entry_rad || phi > im.exit_rad) continue;
          const auto radius = [&](int t) {
            return tool.runout_m * std::cos(tool.runout_angle_rad + t * 2 * pi / tool.teeth);
          };
          const double chip = dx * ex + dy * ey + radius(j) - radius(j - 1);
          if (chip <= 0) continue;
          const double Ft = (k.Ktc_N_per_m2 * chip + k.Kte_N_per_m) * dz, Fr = (k.Krc_N_per_m2 * chip + k.Kre_N_per_m) * dz;
          // clockwise: the tooth moves towards (ey, -ex); the force on it is against that, and inwards
          sum.force_x_N += (-Ft * ey - Fr * ex) / angles;
          sum.force_y_N += (Ft * ex - Fr * ey) / angles;
          sum.torque_Nm += Ft * tool.diameter_m / 2 / angles;
        }
      }
    }
  }
  return sum;
}

TEST(MillingForce, ATickWithHelixRunOutAndAnyHeadingAgreesWithThePlainSum) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const ToolParameters tool{.diameter_m = 6e-3,
                              .teeth = 1 + static_cast<int>(4 * u(random)),
                              .helix_rad = u(random) < 0.5 ? 0.0 : 0.5 * u(random),
                              .runout_m = u(random) < 0.5 ? 0.0 : 20e-6 * u(random),
                              .runout_angle_rad = 6 * u(random)};
    Engagement e;
    e.count = 1 + static_cast<int>(2 * u(random));
    const double middle = pi * u(random);
    e.immersions[0] = {0.0, middle, 1e-3 * u(random)};
    e.immersions[1] = {middle, pi, 1e-3 * u(random)};
    e.heading_rad = 2 * pi * (u(random) - 0.5);
    const double c = 30e-6, off = 0.3 * (u(random) - 0.5), angle = 6 * u(random), turn = 0.1 + 1.5 * u(random);
    const double dx = c * std::cos(e.heading_rad + off), dy = c * std::sin(e.heading_rad + off);
    const auto got = MillingForce(tool, aluminium).over(angle, turn, dx, dy, e);
    const auto want = brute_force(tool, aluminium, angle, turn, dx, dy, e);
    const double scale = 0.02 + std::hypot(want.force_x_N, want.force_y_N);
    EXPECT_NEAR(got.force_x_N, want.force_x_N, 0.005 * scale) << i;
    EXPECT_NEAR(got.force_y_N, want.force_y_N, 0.005 * scale) << i;
    EXPECT_NEAR(got.torque_Nm, want.torque_Nm, 0.005 * (want.torque_Nm + 1e-4)) << i;
  }
}

TEST(MillingForce, CounterclockwiseIsTheMirrorImage) {
  const MillingForce milling({.diameter_m = 6e-3, .teeth = 2}, aluminium);
  const auto right = mean_over_turns(milling, 50e-6, 0, slot(1e-3), 40);
  const auto left = mean_over_turns(milling, 50e-6, 0, slot(1e-3), 40, 1, -1.0);
  EXPECT_NEAR(left.force_x_N, right.force_x_N, 1e-9);
  EXPECT_NEAR(left.force_y_N, -right.force_y_N, 1e-9);
  EXPECT_NEAR(left.torque_Nm, right.torque_Nm, 1e-12);
}

TEST(MillingForce, TheMeanOverTurnsDoesNotDependOnTheTick) {
  const MillingForce milling({.diameter_m = 6e-3, .teeth = 2, .helix_rad = 0.5}, aluminium);
  const auto fine = mean_over_turns(milling, 50e-6, 0, slot(1e-3), 1000, 7);
  for (const int ticks : {8, 13, 20}) {
    const auto coarse = mean_over_turns(milling, 50e-6, 0, slot(1e-3), ticks, 7);
    EXPECT_NEAR(coarse.torque_Nm / fine.torque_Nm, 1.0, 1e-12) << ticks;
    EXPECT_NEAR(coarse.force_y_N / fine.force_y_N, 1.0, 1e-12) << ticks;
  }
}

}  // namespace
}  // namespace feedtwin::plant
