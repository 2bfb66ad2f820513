#include "tools/identify/stages/inverse_projection.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>

#include "plant/lugre.h"
#include "tools/identify/lanes/dispatch.h"

namespace feedtwin::tools {
namespace {

constexpr double tick_s = 1e-3;

/// Two runs of a sine, as long as they please, and forces of an axis with noise.
struct Record {
  std::vector<double> velocity[2], acceleration[2], force_N[2];

  explicit Record(std::mt19937_64& random) {
    std::normal_distribution<double> noise_N(0.0, 1.0);
    for (std::size_t run = 0; run < 2; ++run) {
      const double speed = run == 0 ? 0.03 : 2e-4, rate = run == 0 ? 3.0 : 20.0;
      for (int i = 0; i < (run == 0 ? 1500 : 777); ++i) {
        velocity[run].push_back(speed * std::sin(rate * tick_s * i));
        acceleration[run].push_back(speed * rate * std::cos(rate * tick_s * i));
        force_N[run].push_back(0.0);
      }
      const auto z_and_rate = bristle(friction_shape({13.2, -1.3, -7.1}), run);
      for (std::size_t i = 0; i < velocity[run].size(); ++i) {
        force_N[run][i] = 60.0 * acceleration[run][i] + 80.0 * z_and_rate(static_cast<Eigen::Index>(i), 0) +
                          2e3 * z_and_rate(static_cast<Eigen::Index>(i), 1) + 900.0 * velocity[run][i] + 4.0 +
                          noise_N(random);
      }
    }
  }

  /// Mean force in units of F_C and mean rate, tick by tick, by the plant's step.
  [[nodiscard]] Eigen::MatrixXd bristle(const lanes::FrictionShape& shape, std::size_t run) const {
    Eigen::MatrixXd of(static_cast<Eigen::Index>(velocity[run].size()), 2);
    double z_m = 0.0;
    for (Eigen::Index i = 0; i < of.rows(); ++i) {
      const double v = velocity[run][static_cast<std::size_t>(i)];
      const auto step = plant::lugre_step<double>({shape.per_length_per_m, 1.0 / shape.per_length_per_m, 0.0},
                                                  {1.0, shape.rise, shape.inverse_stribeck_s_per_m, 0.0},
                                                  v < 0.0 ? -1.0 : 1.0, std::abs(v), z_m, tick_s, 1.0 / tick_s);
      of.row(i) << step.force_N, (step.bristle_m - z_m) / tick_s;
      z_m = step.bristle_m;
    }
    return of;
  }

  /// What is left of the forces after the best five linear numbers, the long way.
  [[nodiscard]] double cost(const Eigen::Vector3d& x) const {
    Eigen::MatrixXd regressors(0, 5);
    Eigen::VectorXd measured(0);
    for (std::size_t run = 0; run < 2; ++run) {
      const auto z_and_rate = bristle(friction_shape(x), run);
      const Eigen::Index first = regressors.rows(), count = z_and_rate.rows();
      regressors.conservativeResize(first + count, 5);
      measured.conservativeResize(first + count);
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        regressors.row(first + i) << acceleration[run][at], z_and_rate(i, 0), z_and_rate(i, 1), velocity[run][at], 1.0;
        measured[first + i] = force_N[run][at];
      }
    }
    return (regressors * regressors.colPivHouseholderQr().solve(measured) - measured).squaredNorm();
  }

  [[nodiscard]] InverseMotion motion() const {
    InverseMotion of;
    for (std::size_t run = 0; run < 2; ++run) {
      of.runs.push_back({velocity[run].size(), tick_s, velocity[run].data(), acceleration[run].data(), force_N[run].data()});
      of.products += motion_products(of.runs.back());
    }
    return of;
  }
};

// By every instruction set: the sum of squares that is left, and its exact gradient (Kaufman's slopes leave none of it out).
TEST(InverseProjection, GivesWhatTheBestLinearNumbersLeaveAndItsSlopes) {
  std::mt19937_64 random(71);
  const Record record(random);
  const InverseMotion motion = record.motion();
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  for (const auto& kernel : lanes::usable_kernels()) {
    lanes::use_no_wider_than(kernel.width);
    const InverseProjection projected(motion);
    for (int round = 0; round < 10; ++round) {
      const Eigen::Vector3d x = Eigen::Vector3d(13.2, -1.3, -7.1) + Eigen::Vector3d(off(random), off(random), off(random));
      const auto point = projected.project(x);
      const double cost = record.cost(x);
      EXPECT_NEAR(point.cost, cost, 1e-8 * cost) << kernel.instructions << round;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::Vector3d step = 1e-3 * Eigen::Vector3d::Unit(k);
        const double slope = (record.cost(x + step) - record.cost(x - step)) / 2e-3;
        EXPECT_NEAR(2.0 * point.gradient[k], slope, 1e-3 * std::abs(slope) + 1e-5 * std::sqrt(point.curvature(k, k) * cost))
            << kernel.instructions << round << ' ' << k;
      }
    }
  }
  lanes::use_no_wider_than(std::numeric_limits<std::size_t>::max());
}

}  // namespace
}  // namespace feedtwin::tools
