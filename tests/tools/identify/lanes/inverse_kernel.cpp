#include "tools/identify/lanes/inverse_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/lugre.h"
#include "tools/identify/lanes/dispatch.h"

namespace feedtwin::tools::lanes {
namespace {

double logarithmic(std::mt19937_64& random, double low, double high) {
  return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
}

struct Motion {
  std::vector<double> velocity, acceleration, force;
  [[nodiscard]] MotionView view() const {
    return {velocity.size(), 1e-3, velocity.data(), acceleration.data(), force.data()};
  }
};

/// Any motion: standing, creeping, reversing, fast.
Motion any_motion(std::mt19937_64& random, std::size_t ticks) {
  std::normal_distribution<double> unit;
  std::bernoulli_distribution stands(0.1);
  const double rate = logarithmic(random, 1.0, 100.0), speed = logarithmic(random, 1e-5, 0.2);
  Motion motion;
  for (std::size_t i = 0; i < ticks; ++i) {
    motion.velocity.push_back(stands(random) ? 0.0 : speed * std::sin(rate * 1e-3 * static_cast<double>(i)));
    motion.acceleration.push_back(unit(random));
    motion.force.push_back(100.0 * unit(random));
  }
  return motion;
}

/// The same sums, one shape and one product at a time, by the plant's step for one axis.
InverseSums plain_sums(const MotionView& motion, std::span<const FrictionShape> shapes) {
  InverseSums sums;
  std::array<double, shapes_at_once> z_m{};
  for (std::size_t i = 0; i < motion.ticks; ++i) {
    std::array<double, bristle_columns + motion_columns> row{};
    const double v = motion.velocity_m_per_s[i], sign = v < 0.0 ? -1.0 : 1.0;
    for (std::size_t s = 0; s < shapes_at_once; ++s) {
      const auto step = plant::lugre_step<double>({shapes[s].per_length_per_m, 1.0 / shapes[s].per_length_per_m, 0.0},
                                                  {1.0, shapes[s].rise, shapes[s].inverse_stribeck_s_per_m, 0.0}, sign,
                                                  std::abs(v), z_m[s], motion.tick_s, 1.0 / motion.tick_s);
      row[s] = step.force_N;
      row[shapes_at_once + s] = (step.bristle_m - z_m[s]) / motion.tick_s;
      z_m[s] = step.bristle_m;
    }
    for (std::size_t s = 1; s < shapes_at_once; ++s) {
      row[s] -= row[0];
      row[shapes_at_once + s] -= row[shapes_at_once];
    }
    row[bristle_columns] = motion.acceleration_m_per_s2[i];
    row[bristle_columns + 1] = v;
    row[bristle_columns + 2] = 1.0;
    row[bristle_columns + 3] = motion.force_N[i];
    for (std::size_t a = 0; a < bristle_columns; ++a)
      for (std::size_t b = 0; b < row.size(); ++b) sums.products[a][b] += row[a] * row[b];
  }
  return sums;
}

// Every instruction set, every length (whole blocks and not), any friction: the sums that the plant's own step gives.
TEST(InverseKernel, EveryInstructionSetGivesTheSumsOfThePlantsStep) {
  std::mt19937_64 random(41);
  for (int round = 0; round < 40; ++round) {
    const Motion motion = any_motion(random, std::uniform_int_distribution<std::size_t>(1, 400)(random));
    std::array<FrictionShape, shapes_at_once> shapes;
    for (auto& shape : shapes)
      shape = {logarithmic(random, 1e4, 1e7), logarithmic(random, 1e-3, 3.0), logarithmic(random, 10.0, 1e5)};
    const auto right = plain_sums(motion.view(), shapes);
    for (const auto& kernel : usable_kernels()) {
      InverseSums sums;
      kernel.inverse(motion.view(), shapes.data(), sums);
      for (std::size_t a = 0; a < bristle_columns; ++a) {
        for (std::size_t b = 0; b < bristle_columns + motion_columns; ++b) {
          const double size = std::sqrt(right.products[a][a] * (b < bristle_columns ? right.products[b][b] : 1e6));
          ASSERT_NEAR(sums.products[a][b], right.products[a][b], 1e-9 * size + 1e-12)
              << kernel.instructions << " round " << round << ", " << motion.velocity.size() << " ticks, columns " << a
              << ' ' << b;
        }
      }
    }
  }
}

TEST(InverseKernel, AddsToWhatIsThere) {
  std::mt19937_64 random(42);
  const Motion motion = any_motion(random, 100);
  const std::array<FrictionShape, shapes_at_once> shapes{
      {{5e5, 0.2, 1e3}, {6e5, 0.2, 1e3}, {5e5, 0.3, 1e3}, {5e5, 0.2, 2e3}}};
  InverseSums once, twice;
  const auto kernel = best_kernel().inverse;
  kernel(motion.view(), shapes.data(), once);
  kernel(motion.view(), shapes.data(), twice);
  kernel(motion.view(), shapes.data(), twice);
  for (std::size_t a = 0; a < bristle_columns; ++a)
    for (std::size_t b = 0; b < bristle_columns + motion_columns; ++b)
      EXPECT_DOUBLE_EQ(twice.products[a][b], 2.0 * once.products[a][b]) << a << ' ' << b;
}

}  // namespace
}  // namespace feedtwin::tools::lanes
