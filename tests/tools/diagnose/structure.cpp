// What is no noise: what repeats with place, speed and time since reversal, and lines of one frequency.

#include "tools/diagnose/structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/lines.h"
#include "tools/diagnose/taken_up.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

struct Runs : testing::Test {
  InverseModel model{make_tracks(made(), plant::source_axis()), plant::source_axis()};
  std::mt19937 random{11};  // NOLINT(bugprone-random-generator-seed): the same runs every time

  static std::vector<tools::Recording> made() {
    std::vector<tools::Recording> runs;
    for (const char* motion : {"sine", "triangle"})
      runs.push_back(tests::make_recording(plant::source_axis(), {.motion = motion, .duration_s = 8.0}));
    return runs;
  }
  [[nodiscard]] Vector rows_of(const std::function<double(const Track&, Index)>& value) const {
    Vector rows = Vector::Zero(model.rows());  // of the force equations
    for (const auto& s : model.segments())
      for (Index i = 0; i < s.size && !model.equations()[s.equation].slip && !model.equations()[s.equation].power; ++i)
        rows[s.start + i] = value(model.tracks()[s.run], model.sample_of(s, i));
    return rows;
  }
  /// How many equations of the force there are: their sum holds such rows so many times.
  [[nodiscard]] double force_equations() const {
    return static_cast<double>(
        std::ranges::count_if(model.equations(), [](const Equation& e) { return !e.slip && !e.power; }));
  }
  [[nodiscard]] Vector noise() {
    std::normal_distribution<double> normal;
    return rows_of([&](const Track&, Index) { return normal(random); });
  }
  /// Norm over the rows where the axis has settled.
  [[nodiscard]] double settled_norm(const Vector& rows) const {
    double square = 0.0;
    for (Index k = 0; k < rows.size(); ++k) square += model.settled(k) ? rows[k] * rows[k] : 0.0;
    return std::sqrt(square);
  }
};

TEST_F(Runs, WhatRepeatsIsFoundAndNothingInNoise) {
  const RepeatableStructure structure(model);
  const Vector hiss = noise(), both = hiss + rows_of([](const Track& t, Index k) { return 400.0 * t.position_m[k]; });
  EXPECT_LT(structure.part_of(hiss).norm(), 0.3 * hiss.norm());
  EXPECT_LT(structure.remaining(hiss).share, 0.05);
  EXPECT_GT(structure.remaining(both).share, 0.3);
  EXPECT_LT((both - structure.part_of(both)).norm(), 0.9 * both.norm());
}

TEST_F(Runs, ASpringAndABumpArePredictedWhereTheyWereNotSeen) {
  const RepeatableStructure structure(model);
  const Vector spring = rows_of([](const Track& t, Index k) { return 400.0 * t.position_m[k]; });
  const Vector bump = rows_of([](const Track& t, Index k) {
    return std::copysign(20.0 * std::exp(-std::pow((t.position_m[k] - 0.003) / 0.002, 2)), t.centred_m_per_s[k]);
  });
  EXPECT_LT(settled_norm(spring - structure.part_of(spring)), 0.35 * settled_norm(spring));
  EXPECT_LT(settled_norm(bump - structure.part_of(bump)), 0.5 * settled_norm(bump));
}

// A pump's pulses, every 1.7 s by the clock, whatever the axis does.
TEST_F(Runs, PulsesByTheClockArePredictedInPartsOfRunsThatWereNotSeen) {
  const RepeatableStructure structure(model);
  const Vector pulses = rows_of([](const Track& t, Index k) {
    return 5.0 * std::exp(-std::fmod(static_cast<double>(k) * t.sample_s + 0.4, 1.7) / 0.35);
  });
  const Structure found = structure.remaining(noise() + pulses);
  EXPECT_GT(found.share, 0.3);
  EXPECT_LT(found.gives_way, 0.1) << "no spring does that";
}

// A hose that kicks for 0.05 s, every 0.83 s: no three waves are so short.
TEST_F(Runs, ShortPulsesByTheClockArePredictedInPartsOfRunsThatWereNotSeen) {
  const RepeatableStructure structure(model);
  const Vector pulses = rows_of(
      [](const Track& t, Index k) { return std::fmod(static_cast<double>(k) * t.sample_s + 0.4, 0.83) < 0.05 ? 6.0 : 0.0; });
  EXPECT_GT(structure.remaining(noise() + pulses).share, 0.4);
}

// A brake that lets go late: a drag that is gone 0.35 s after each rest.
TEST_F(Runs, ADragAfterEachRestIsPredictedWhereItWasNotSeen) {
  auto runs = made();  // their reversals are none
  runs.push_back(
      tests::make_recording(plant::source_axis(), {.motion = "s_curve", .settings = {.dwell_s = 0.6}, .duration_s = 8.0}));
  const InverseModel rests(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const RepeatableStructure structure(rests);
  std::normal_distribution<double> normal;
  Vector rows = Vector::Zero(rests.rows());
  for (const auto& s : rests.segments()) {
    const Track& t = rests.tracks()[s.run];
    std::vector<double> drag_N;
    double since_s = 1e3, at_rest_s = 0.0;
    for (Index k = 0; k < t.size; ++k) {
      at_rest_s = std::abs(t.steady_m_per_s[k]) < 1e-3 ? at_rest_s + t.sample_s : 0.0;
      since_s = at_rest_s > 0.2 ? 0.0 : since_s + t.sample_s;
      drag_N.push_back(std::copysign(8.0 * std::exp(-since_s / 0.35), t.centred_m_per_s[k]));
    }
    for (Index i = 0; i < s.size; ++i)
      rows[s.start + i] = normal(random) + drag_N[static_cast<std::size_t>(rests.sample_of(s, i))];
  }
  EXPECT_GT(structure.remaining(rows).share, 0.4) << "the time since a reversal tells 0.27 of it";
}

// Rough going pushes the axis at random, and the axis gives way: the force is then found in the accelerations that it made.
TEST(Structure, AForceThatMovesTheAxisIsNotToldByTheMotionThatItMakes) {
  std::mt19937 random{5};  // NOLINT(bugprone-random-generator-seed): the same runs every time
  std::uniform_real_distribution<double> frequency_Hz(5.0, 16.0), phase_rad(0.0, 2.0 * std::numbers::pi);
  std::vector<tools::Recording> runs;
  for (const char* motion : {"sine", "triangle", "s_curve"}) {
    auto axis = plant::source_axis();
    for (int i = 0; i < 24; ++i)
      axis.effects.push_back(
          tests::effect("process_force",
                        {{"amplitude_N", 1.0}, {"frequency_Hz", frequency_Hz(random)}, {"phase_rad", phase_rad(random)}}));
    runs.push_back(tests::make_recording(axis, {.motion = motion, .duration_s = 8.0}));
  }
  const InverseModel model(make_tracks(runs, plant::source_axis()), plant::source_axis());
  const Structure found = RepeatableStructure(model).remaining(model.residual(plant::source_axis(), {}));
  EXPECT_GT(found.remainder_N, 2.0);
  EXPECT_LT(found.share, 0.05);
}

/// Several speeds in each run, at every place.
struct RunsOfSpeeds : testing::Test {
  InverseModel model{make_tracks(made(), plant::source_axis()), plant::source_axis()};
  std::mt19937 random{11};  // NOLINT(bugprone-random-generator-seed): the same runs every time

  static std::vector<tools::Recording> made() {
    std::vector<tools::Recording> runs;
    for (const double slowest : {0.01, 0.015, 0.02})
      runs.push_back(tests::make_recording(
          plant::source_axis(), {.motion = "stair",
                                 .settings = {.speed_m_per_s = 0.14, .slowest_m_per_s = slowest, .steps = 7, .hold_s = 0.5},
                                 .duration_s = 9.0}));
    return runs;
  }
  /// Beside noise of a newton. @param force_N of a track, sample by sample
  [[nodiscard]] Structure of(const std::function<std::vector<double>(const Track&)>& force_N) {
    std::normal_distribution<double> normal;
    Vector rows = Vector::Zero(model.rows());
    for (const auto& s : model.segments()) {
      const auto force = force_N(model.tracks()[s.run]);
      for (Index i = 0; i < s.size; ++i)
        rows[s.start + i] = normal(random) + force[static_cast<std::size_t>(model.sample_of(s, i))];
    }
    return RepeatableStructure(model).remaining(rows);
  }
};

// A drive that folds back, a bus that sags: torque that weakens by what has been asked of it in the seconds before.
TEST_F(RunsOfSpeeds, TorqueThatFadesUnderLoadIsPredictedWhereItWasNotSeen) {
  const auto found = of([](const Track& t) {
    std::vector<double> lost_N;
    double load = 0.0;
    for (Index k = 0; k < t.size; ++k) {
      load += (std::abs(t.command_N[k]) - load) * t.sample_s / 2.0;
      lost_N.push_back(2e-3 * t.command_N[k] * load);
    }
    return lost_N;
  });
  EXPECT_GT(found.share, 0.7) << "0.43 of it without what fades";
}

// A cover that chatters on one half of the travel, at some speeds.
TEST_F(RunsOfSpeeds, ADragInOneRegionAtSomeSpeedsIsPredictedWhereItWasNotSeen) {
  const auto found = of([](const Track& t) {
    std::vector<double> drag_N;
    for (Index k = 0; k < t.size; ++k) {
      const double v = t.centred_m_per_s[k];
      const bool chatters = t.position_m[k] > 0.01 && std::abs(v) > 0.03 && std::abs(v) < 0.07;
      drag_N.push_back(chatters ? std::copysign(4.0, v) : 0.0);
    }
    return drag_N;
  });
  EXPECT_GT(found.share, 0.63) << "0.57 of it without speed by region";
}

// A bellows or a leaking cylinder: a spring's force that is gone in a second.
TEST_F(Runs, ASpringThatGivesWayIsPredictedThoughNoPlaceHasItsForce) {
  const RepeatableStructure structure(model);
  std::vector<std::vector<double>> force_N;
  for (const auto& t : model.tracks()) {
    double strain_m = 0.0;
    force_N.emplace_back();
    for (Index k = 0; k < t.size; ++k) {
      strain_m += t.sample_s * (t.centred_m_per_s[k] - strain_m / 0.6);
      force_N.back().push_back(900.0 * strain_m);
    }
  }
  const Vector gives_way = rows_of([&](const Track& t, Index k) { return force_N[t.run][static_cast<std::size_t>(k)]; });
  const auto found = structure.remaining(gives_way);
  EXPECT_GT(found.share, 0.85);
  EXPECT_GT(found.gives_way, 0.1);
}

TEST_F(Runs, ABeatIsFoundBelowTheNoiseWithItsPhaseInEachRun) {
  const RepeatableStructure structure(model);
  const Vector beat = rows_of([](const Track& t, Index k) {
    const double angle = 2.0 * std::numbers::pi * 0.71 * static_cast<double>(k) * t.sample_s + static_cast<double>(t.run);
    return (t.centred_m_per_s[k] > 0.0 ? 1.0 : -1.0) * std::sin(angle);
  });
  EXPECT_LT(settled_norm(beat - structure.part_of(beat)), 0.2 * settled_norm(beat));
  EXPECT_GT(structure.remaining(noise() + beat).share, 0.25);
}

TEST_F(Runs, APartThatRingsIsFoundByItsFrequencyWhereTheMotionSetsItOff) {
  const RepeatableStructure structure(model);
  constexpr double mass_kg = 8.0, frequency_Hz = 6.2, damping_ratio = 0.02, w = 2.0 * std::numbers::pi * frequency_Hz;
  std::vector<std::vector<double>> force_N;  // -m (w^2 z + 2 d w z') of z'' + 2 d w z' + w^2 z = -a, in tenths of a sample
  for (const auto& t : model.tracks()) {
    double z = 0.0, speed = 0.0;
    force_N.emplace_back();
    for (Index k = 0; k < t.size; ++k) {
      force_N.back().push_back(-mass_kg * w * (w * z + 2.0 * damping_ratio * speed));
      for (int i = 0; i < 10; ++i) {
        speed += 0.1 * t.sample_s * (-t.table_acceleration_m_per_s2[k] - w * (w * z + 2.0 * damping_ratio * speed));
        z += 0.1 * t.sample_s * speed;
      }
    }
  }
  const Vector rings = rows_of([&](const Track& t, Index k) { return force_N[t.run][static_cast<std::size_t>(k)]; });
  const double loud = 2.0 * std::sqrt(static_cast<double>(rings.size())) / rings.norm();  // twice the noise
  const auto found = structure.remaining(noise() + loud * rings);
  EXPECT_GT(found.share, 0.5);
  ASSERT_TRUE(found.rings.has_value());
  EXPECT_NEAR(found.rings->frequency_Hz, frequency_Hz, 0.03 * frequency_Hz);
  EXPECT_NEAR(found.rings->mass_kg / (loud * force_equations()), mass_kg, 0.3 * mass_kg);
}

TEST_F(Runs, NoiseThatRingsByItselfIsNoStructure) {
  const RepeatableStructure structure(model);
  const Vector hiss = noise();
  double last = 0.0, before = 0.0;  // a pole at 6 Hz, 2 % damped, rows of 4 ms
  const double turn = 2.0 * std::numbers::pi * 6.0 * 0.004, kept = std::exp(-0.02 * turn);
  Vector coloured = hiss;
  for (double& value : coloured) {
    value += 2.0 * kept * std::cos(turn) * last - kept * kept * before;
    before = last, last = value;
  }
  EXPECT_LT(structure.remaining(coloured).share, 0.05);
}

TEST_F(Runs, WhatMassAndFrictionCouldTakeUpIsNoStructure) {
  const RepeatableStructure structure(model);
  const Vector mass_and_friction = rows_of([](const Track& t, Index k) {
    const double v = t.centred_m_per_s[k];
    return 2.0 * slow_acceleration_m_per_s2(t, k) + 30.0 * v + (v > 0.0 ? 1.0 : -0.4);
  });
  EXPECT_LT(structure.remaining(noise() + mass_and_friction).share, 0.05);
  EXPECT_NEAR(structure.remaining(mass_and_friction).remainder_N, 0.0, 0.05);
}

TEST_F(Runs, LinesAreFoundWithTheirPhaseAndNoneInNoise) {
  const Vector hiss = noise();
  EXPECT_EQ(sharp_lines(model, hiss).norm(), 0.0);
  const Vector line = rows_of([](const Track& t, Index k) {
    const double time_s = static_cast<double>(k) * t.sample_s;
    return std::sin(2.0 * std::numbers::pi * 23.456 * time_s + 0.3) + 0.5 * std::sin(2.0 * std::numbers::pi * 61.7 * time_s);
  });
  EXPECT_LT(settled_norm(sharp_lines(model, hiss + line) - line), 0.2 * settled_norm(line));
}

TEST_F(Runs, ColouredNoiseHasNoLines) {
  double state = 0.0;
  std::normal_distribution<double> normal;
  const Vector coloured = rows_of([&](const Track&, Index) { return state = 0.9 * state + normal(random); });
  EXPECT_EQ(sharp_lines(model, coloured).norm(), 0.0);
}

}  // namespace
}  // namespace feedtwin
