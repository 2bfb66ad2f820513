// Friction followed in lanes: whatever the group, each motion comes out as alone by the plant's step for one axis.

#include "tools/identify/lanes/follow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/made_case.h"
#include "tools/identify/lanes/dispatch.h"

namespace feedtwin::tools::lanes {
namespace {

constexpr std::size_t substeps = 4;
constexpr double substep_s = 2.5e-4;

struct Made {
  plant::Contacts<double> contacts;
  std::vector<double> path, table_path, sliding, viscous, guide_sliding, guide_viscous, screw_N, guide_N;
  [[nodiscard]] FollowedMotion view() {
    const auto factors = [](const std::vector<double>& of) { return of.empty() ? nullptr : of.data(); };
    return {&contacts,
            screw_N.size(),
            substeps,
            substep_s,
            path.data(),
            table_path.data(),
            factors(sliding),
            factors(viscous),
            factors(guide_sliding),
            factors(guide_viscous),
            screw_N.data(),
            guide_N.data()};
  }
};

/// Any axis on any motion: standing, creeping, reversing; with friction scaled or not.
Made any(std::mt19937_64& random) {
  const auto factor = [&random](double most) {
    return std::exp(std::uniform_real_distribution<double>(-std::log(most), std::log(most))(random));
  };
  auto axis = plant::source_axis();
  axis.ball_screw.coulomb_N.pos *= factor(2.0);
  axis.ball_screw.static_N.pos = 1.3 * axis.ball_screw.coulomb_N.pos;
  axis.guide.stiffness_N_per_m *= factor(3.0);
  Made made{plant::make_axis_model(axis).contacts, {}, {}, {}, {}, {}, {}, {}, {}};
  const std::size_t samples = std::uniform_int_distribution<std::size_t>(1, 400)(random);
  const double rate = 20.0 * factor(10.0), speed = 1e-2 * factor(100.0);
  std::bernoulli_distribution stands(0.1), scaled(0.5);
  for (std::size_t i = 0; i < substeps * samples; ++i) {
    const double v = stands(random) ? 0.0 : speed * std::sin(rate * substep_s * static_cast<double>(i));
    made.path.push_back(v);
    made.table_path.push_back(0.9 * v);
  }
  for (auto* factors : {&made.sliding, &made.viscous, &made.guide_sliding, &made.guide_viscous})
    if (scaled(random))
      for (std::size_t k = 0; k < samples; ++k) factors->push_back(factor(2.0));
  made.screw_N.assign(samples, std::nan(""));
  made.guide_N.assign(samples, std::nan(""));
  return made;
}

void expect_as_alone(const Made& made) {
  double screw_m = 0.0, guide_m = 0.0, largest = 0.0;
  const auto along = [](double v) {
    return plant::Sliding<double>{v < 0.0 ? -1.0 : 1.0, std::abs(v), substep_s, 1.0 / substep_s};
  };
  for (std::size_t k = 0; k < made.screw_N.size(); ++k) {
    plant::FrictionScale<double> scale;
    if (!made.sliding.empty()) scale.screw_sliding = made.sliding[k];
    if (!made.viscous.empty()) scale.screw_viscous = made.viscous[k];
    if (!made.guide_sliding.empty()) scale.guide_sliding = made.guide_sliding[k];
    if (!made.guide_viscous.empty()) scale.guide_viscous = made.guide_viscous[k];
    double screw_N = 0.0, guide_N = 0.0;
    for (std::size_t i = k * substeps; i < (k + 1) * substeps; ++i) {
      const auto screw = made.contacts.step(along(made.path[i]), screw_m, 0.0, scale);
      const auto guide = made.contacts.step(along(made.table_path[i]), 0.0, guide_m, scale);
      screw_N += screw.screw_force_N / substeps;
      guide_N += guide.guide_force_N / substeps;
      screw_m = screw.screw_bristle_m;
      guide_m = guide.guide_bristle_m;
    }
    largest = std::max(largest, std::abs(screw_N) + std::abs(guide_N));
    ASSERT_NEAR(made.screw_N[k], screw_N, 1e-9 * (1.0 + largest)) << k;
    ASSERT_NEAR(made.guide_N[k], guide_N, 1e-9 * (1.0 + largest)) << k;
  }
}

TEST(FollowedFriction, IsInEveryLaneWhatItIsAlone) {
  std::mt19937_64 random(91);
  for (const auto& kernel : usable_kernels()) {
    use_no_wider_than(kernel.width);
    for (const std::size_t count : {1U, 2U, 3U, 7U, 8U, 21U}) {
      std::vector<Made> all;
      std::vector<FollowedMotion> motions;
      for (std::size_t i = 0; i < count; ++i) all.push_back(any(random));
      for (auto& one : all) motions.push_back(one.view());
      follow_friction(motions);
      for (const auto& one : all) expect_as_alone(one);
    }
  }
  use_no_wider_than(std::numeric_limits<std::size_t>::max());
}

}  // namespace
}  // namespace feedtwin::tools::lanes
