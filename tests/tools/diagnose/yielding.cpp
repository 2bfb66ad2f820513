// What clings to where it was and gives way after a path is structure that no place, speed or time tells.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "tests/support/made_case.h"
#include "tools/diagnose/structure.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Strokes of any length, at any speed.
std::vector<tools::Recording> wandering_runs() {
  std::vector<tools::Recording> runs;
  for (const double run : {0.0, 1.0}) {
    auto& made = runs.emplace_back(tests::make_recording(plant::source_axis(), {.motion = "sine", .duration_s = 8.0}));
    auto& position_m = made.channels.at(std::string(tools::channel::position_m));
    for (std::size_t k = 0; k < position_m.size(); ++k) {
      const double turn = 2.0 * std::numbers::pi * static_cast<double>(k) * made.sample_s;
      position_m[k] =
          0.010 * std::sin(0.31 * turn + run) + 0.006 * std::sin(0.83 * turn) + 0.003 * std::sin(1.9 * turn + 2.0 * run);
    }
  }
  return runs;
}

// A seal that gives way after three millimetres.
TEST(Yielding, IsPredictedWhereItWasNotSeen) {
  const InverseModel model(make_tracks(wandering_runs(), plant::source_axis()), plant::source_axis());
  std::mt19937 random{11};  // NOLINT(bugprone-random-generator-seed): the same runs every time
  std::normal_distribution<double> normal;
  Vector rows = Vector::Zero(model.rows());
  for (const auto& s : model.segments()) {
    const Track& t = model.tracks()[s.run];
    std::vector<double> clings{0.0};
    for (Index k = 1; k < t.size; ++k)
      clings.push_back(std::clamp(clings.back() + (t.position_m[k] - t.position_m[k - 1]) / 0.003, -1.0, 1.0));
    for (Index i = 0; i < s.size; ++i)
      rows[s.start + i] = normal(random) + 2.0 * clings[static_cast<std::size_t>(model.sample_of(s, i))];
  }
  EXPECT_GT(RepeatableStructure(model).remaining(rows).share, 0.45) << "0.29 of it by place, speed and time";
}

}  // namespace
}  // namespace feedtwin
