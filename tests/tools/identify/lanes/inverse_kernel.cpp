#include "tools/identify/lanes/inverse_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plant/lugre.h"
#include "tools/identify/lanes/block_columns.h"
#include "tools/identify/lanes/dispatch.h"
#include "tools/identify/lanes/inverse_kernel_body.h"

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

using Columns = std::vector<std::array<double, 2>>;  // mean force and rate of each tick

/// By the plant's step, tick by tick.
Columns plain_columns(const MotionView& motion, const FrictionShape& shape) {
  Columns columns;
  double z_m = 0.0;
  for (std::size_t i = 0; i < motion.ticks; ++i) {
    const double v = motion.velocity_m_per_s[i], sign = v < 0.0 ? -1.0 : 1.0;
    const auto step = plant::lugre_step<double>({shape.per_length_per_m, 1.0 / shape.per_length_per_m, 0.0},
                                                {1.0, shape.rise, shape.inverse_stribeck_s_per_m, 0.0}, sign, std::abs(v),
                                                z_m, motion.tick_s, 1.0 / motion.tick_s);
    columns.push_back({step.force_N, (step.bristle_m - z_m) / motion.tick_s});
    z_m = step.bristle_m;
  }
  return columns;
}

/// Likewise the slopes, from differences to either side.
Columns plain_slopes(const MotionView& motion, FrictionShape shape, std::size_t by) {
  constexpr double small = 1e-4;
  FrictionShape less = shape;
  const double more = std::exp(small);
  if (by == 0) {
    shape.per_length_per_m *= more;
    less.per_length_per_m /= more;
  } else if (by == 1) {
    shape.rise += small;
    less.rise -= small;
  } else {
    shape.inverse_stribeck_s_per_m /= more;
    less.inverse_stribeck_s_per_m *= more;
  }
  Columns slopes = plain_columns(motion, shape);
  const Columns others = plain_columns(motion, less);
  for (std::size_t i = 0; i < slopes.size(); ++i)
    for (const std::size_t c : {0U, 1U}) slopes[i].at(c) = (slopes[i].at(c) - others[i].at(c)) / (2.0 * small);
  return slopes;
}

/// The same sums, one product at a time.
InverseSums plain_sums(const MotionView& motion, const FrictionShape& shape) {
  constexpr std::size_t rate = 1 + shape_slopes;
  std::vector<std::array<double, bristle_columns + motion_columns>> rows(motion.ticks);
  for (std::size_t k = 0; k <= shape_slopes; ++k) {
    const auto columns = k == 0 ? plain_columns(motion, shape) : plain_slopes(motion, shape, k - 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].at(k) = columns[i][0];
      rows[i].at(rate + k) = columns[i][1];
    }
  }
  InverseSums sums;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = rows[i];
    row[bristle_columns] = motion.acceleration_m_per_s2[i];
    row[bristle_columns + 1] = motion.velocity_m_per_s[i];
    row[bristle_columns + 2] = 1.0;
    row[bristle_columns + 3] = motion.force_N[i];
    for (std::size_t a = 0; a < bristle_columns; ++a)
      for (std::size_t b = 0; b < row.size(); ++b) sums.products.at(a).at(b) += row.at(a) * row.at(b);
  }
  return sums;
}

/// A slope's column, which differences give less exactly.
bool slope(std::size_t column) {
  return column < bristle_columns && column % (1 + shape_slopes) != 0;
}

/// Norm of a column, and for a slope that of what it is the slope of: with a stiff bristle there is hardly any.
double size_of(const InverseSums& sums, std::size_t column) {
  if (column >= bristle_columns) return 1e3;
  const std::size_t of = column / (1 + shape_slopes) * (1 + shape_slopes);
  return std::sqrt(sums.products[column][column]) + std::sqrt(sums.products[of][of]) + 1e-9;
}

/// Largest difference of two columns' product over their sizes; those of slopes apart.
std::array<double, 2> worst(const InverseSums& sums, const InverseSums& right) {
  std::array<double, 2> worst{};
  for (std::size_t a = 0; a < bristle_columns; ++a) {
    for (std::size_t b = 0; b < bristle_columns + motion_columns; ++b) {
      auto& of = worst.at(slope(a) || slope(b) ? 1 : 0);
      const double off = std::abs(sums.products[a][b] - right.products[a][b]);
      of = std::max(of, off / (size_of(right, a) * size_of(right, b)));
    }
  }
  return worst;
}

// Every instruction set, every length (whole blocks and not), any friction: the sums that the plant's own step gives, and
// those of one lane by itself to rounding, slopes and all.
TEST(InverseKernel, EveryInstructionSetGivesTheSumsOfThePlantsStep) {
  std::mt19937_64 random(41);
  constexpr std::array<std::size_t, 8> edges{
      1, 2, stream_ticks - 1, stream_ticks, block_ticks - 1, block_ticks, block_ticks + 1, 2 * block_ticks};
  for (std::size_t round = 0; round < 60; ++round) {
    const std::size_t ticks =
        round < edges.size() ? edges.at(round) : std::uniform_int_distribution<std::size_t>(1, 600)(random);
    const Motion motion = any_motion(random, ticks);
    const FrictionShape shape{logarithmic(random, 1e4, 1e7), round % 5 == 0 ? 1e-3 : logarithmic(random, 1e-3, 3.0),
                              logarithmic(random, 10.0, 1e5)};
    const InverseSums plant = plain_sums(motion.view(), shape);
    InverseSums alone;
    run_inverse<plant::Doubles<1>>(motion.view(), shape, alone);
    for (const auto& kernel : usable_kernels()) {
      InverseSums sums;
      kernel.inverse(motion.view(), shape, sums);
      const auto of_plant = worst(sums, plant), of_one_lane = worst(sums, alone);
      EXPECT_LT(of_plant[0], 1e-9) << kernel.instructions << " round " << round << ", " << ticks << " ticks";
      EXPECT_LT(of_plant[1], 1e-5) << kernel.instructions << " round " << round << ", " << ticks << " ticks: slopes";
      EXPECT_LT(std::max(of_one_lane[0], of_one_lane[1]), 1e-9) << kernel.instructions << " round " << round;
    }
  }
}

// A friction without a Stribeck rise still says what a rise would do.
TEST(InverseKernel, HasASlopeByTheRiseWhereThereIsNone) {
  std::mt19937_64 random(43);
  const Motion motion = any_motion(random, 500);
  InverseSums sums, with;
  best_kernel().inverse(motion.view(), {1e6, 0.0, 1e3}, sums);
  best_kernel().inverse(motion.view(), {1e6, 1e-5, 1e3}, with);
  EXPECT_GT(sums.products[2][2], 0.0);
  EXPECT_NEAR(sums.products[2][2], with.products[2][2], 1e-3 * with.products[2][2]);
  EXPECT_EQ(sums.products[3][3], 0.0) << "and no Stribeck velocity";
}

TEST(InverseKernel, AddsToWhatIsThere) {
  std::mt19937_64 random(42);
  const Motion motion = any_motion(random, 100);
  const FrictionShape shape{5e5, 0.2, 1e3};
  InverseSums once, twice;
  const auto kernel = best_kernel().inverse;
  kernel(motion.view(), shape, once);
  kernel(motion.view(), shape, twice);
  kernel(motion.view(), shape, twice);
  for (std::size_t a = 0; a < bristle_columns; ++a)
    for (std::size_t b = 0; b < bristle_columns + motion_columns; ++b)
      EXPECT_DOUBLE_EQ(twice.products[a][b], 2.0 * once.products[a][b]) << a << ' ' << b;
}

}  // namespace
}  // namespace feedtwin::tools::lanes
