// Teeth that pass faster than the usual rows show: rows come closer, where all runs have the line and not otherwise.

#include "tools/diagnose/fast_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/made_case.h"
#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/inverse_model.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

tools::Case cut_at(std::initializer_list<double> frequencies_Hz, double amplitude_N) {
  tools::Case data;
  data.axis = plant::source_axis();
  unsigned seed = 1;
  for (const double frequency_Hz : frequencies_Hz) {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect(
        "process_force", {{"amplitude_N", amplitude_N}, {"frequency_Hz", frequency_Hz}, {"phase_rad", 0.4 * seed}}));
    tests::MadeRun made{.motion = seed % 2 == 0 ? "s_curve" : "sine", .duration_s = 3.0, .sensors = false, .seed = seed};
    made.settings.speed_m_per_s = 0.06, made.settings.amplitude_m = 0.02;
    data.fit.push_back(tests::make_recording(truth, made));
    ++seed;
  }
  data.holdout = {data.fit.back()};
  data.fit.pop_back();
  return data;
}

Index samples_a_row(const tools::Case& data) {
  return track_settings(data, [](std::string_view) {}).samples_a_row;
}

TEST(FastLines, RowsComeAsCloseAsTheLineAsks) {
  EXPECT_EQ(samples_a_row(cut_at({72.0, 72.0, 72.0}, 10.0)), 4) << "the usual rows show it";
  EXPECT_EQ(samples_a_row(cut_at({133.0, 133.0, 133.0}, 10.0)), 2);
  EXPECT_EQ(samples_a_row(cut_at({187.0, 187.0, 187.0}, 10.0)), 2);
  EXPECT_EQ(samples_a_row(cut_at({287.0, 287.0, 287.0}, 20.0)), 1);
}

TEST(FastLines, WithoutOneThatAllRunsHaveTheyStay) {
  EXPECT_EQ(samples_a_row(cut_at({410.0, 410.0, 410.0}, 80.0)), 4) << "no rows show it";
  EXPECT_EQ(samples_a_row(cut_at({133.0, 139.0, 133.0}, 10.0)), 4);
  EXPECT_EQ(samples_a_row(cut_at({133.0, 133.0, 133.0}, 0.0)), 4);
  EXPECT_EQ(samples_a_row(cut_at({100.1, 100.1, 100.1}, 10.0)), 4) << "mains hum, which the usual rows show";
}

TEST(FastLines, ALowPassPassesWhatItsRowsShow) {
  for (const Index samples : {1, 2, 4}) {
    const Vector pass = low_pass_to(samples);
    EXPECT_NEAR(pass.sum(), 1.0, 1e-12);
    double at_highest = 0.0;
    for (Index i = 0; i < pass.size(); ++i)
      at_highest += pass[i] * std::cos(2.0 * std::numbers::pi * highest_line_Hz(samples, 1e-3) * 1e-3 *
                                       static_cast<double>(i - pass.size() / 2));
    EXPECT_NEAR(at_highest, 0.5, 0.05) << samples;
  }
}

TEST(FastLines, TeethAtNearly200HzAreNamedWithTheirSize) {
  const auto found = diagnose(cut_at({181.0, 181.0, 181.0}, 8.0), [](std::string_view) {});
  ASSERT_EQ(found.effects.size(), 1U);
  EXPECT_EQ(found.effects[0].hypothesis->id, "process_force");
  const auto value = [&](std::string_view name) {
    return std::ranges::find(found.effects[0].parameters, name, [](const auto& one) { return one.first; })->second.value;
  };
  EXPECT_NEAR(value("amplitude_N"), 8.0, 0.24);
  EXPECT_NEAR(value("frequency_Hz"), 181.0, 0.05);
}

}  // namespace
}  // namespace feedtwin
