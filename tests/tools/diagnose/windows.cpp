// A process that cuts in a part of each run: where, and with what.

#include "tools/diagnose/windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plant/effects/registry.h"
#include "tests/support/made_case.h"
#include "tools/diagnose/edges.h"
#include "tools/diagnose/fit.h"
#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/own_phase.h"
#include "tools/diagnose/screen.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double frequency_Hz = 71.0, amplitude_N = 6.0, mean_N = 3.0, opposing_N = 2.0;

tools::Recording cut(const Windows& cuts, double phase_rad, double ramp_s = 0.0) {
  auto axis = plant::source_axis();
  for (const Window& in_cut : cuts)
    axis.effects.push_back(tests::effect("process_force", {{"mean_N", mean_N},
                                                           {"opposing_N", opposing_N},
                                                           {"amplitude_N", amplitude_N},
                                                           {"frequency_Hz", frequency_Hz},
                                                           {"phase_rad", phase_rad},
                                                           {"start_s", in_cut.start_s},
                                                           {"end_s", in_cut.end_s},
                                                           {"ramp_s", ramp_s}}));
  auto recording = tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0});
  std::mt19937 random(7);
  std::normal_distribution<double> noise_N(0.0, 0.5);
  for (double& torque_Nm : recording.channels.at("torque_cmd_Nm"))
    torque_Nm += noise_N(random) * axis.axis.lead_m / (2.0 * std::numbers::pi);
  return recording;
}

struct Cut {
  plant::AxisParameters nominal = plant::source_axis();
  tools::Case data = tests::short_case(nominal, nominal);
  InverseModel model, unseen;
  Fitter fitter{model, nominal};
  Whitening whitening;

  Cut(const Windows& first, const Windows& second)
      : model(make_tracks(runs(first, second), nominal), nominal),
        unseen(make_tracks({cut({{0.511, 1.403}}, -2.0)}, nominal), nominal) {
    // of runs without a cut: in such short ones the noise would take the process for its own colour
    const InverseModel calm(make_tracks({cut({}, 0.0), cut({}, 0.0)}, nominal), nominal);
    whitening = Whitening::estimate(calm, calm.residual(nominal, {}));
  }
  std::vector<tools::Recording> runs(const Windows& first, const Windows& second) {
    data.fit = {cut(first, 0.4), cut(second, 1.9)};
    return data.fit;
  }
};

void expect_windows(const Active& process, std::size_t run, const Windows& truth) {
  constexpr double near_s = 0.08;  // about a reversal friction holds the table, and nothing shows
  const auto found = windows_of_run(process.hypothesis->first_window, process.q, run);
  ASSERT_EQ(found.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(found[i].start_s, truth[i].start_s, near_s);
    EXPECT_NEAR(found[i].end_s, truth[i].end_s, near_s);
  }
}

void expect_found(const Windows& first, const Windows& second) {
  const Cut made(first, second);
  Fit fit = made.fitter.fit({made.nominal, {}}, made.whitening, 4);
  const auto scores = screen(made.fitter, fit, made.whitening).scores;
  const auto score = std::ranges::find(scores, &hypothesis("process_force"), &Score::hypothesis);
  fit = fit_with(made.fitter, fit.model, *score, 0, made.whitening, 8);
  const Active& process = fit.model.effects.front();
  ASSERT_TRUE(windowed(process));
  expect_windows(process, 0, first);
  expect_windows(process, 1, second);
  const auto values = process.hypothesis->named(process.q, made.nominal);
  const auto value = [&](std::string_view name) { return std::ranges::find(values, name, &NamedValue::name)->value; };
  EXPECT_NEAR(value("amplitude_N"), amplitude_N, 0.3);
  EXPECT_NEAR(value("frequency_Hz"), frequency_Hz, 0.05);
  EXPECT_NEAR(value("mean_N"), mean_N, 0.5);
  EXPECT_NEAR(value("opposing_N"), opposing_N, 0.5);

  const Active told = for_unseen(made.unseen, made.whitening, fit.model).effects.front();
  expect_windows(told, 0, {{0.511, 1.403}});
}

TEST(Windows, AreFoundWithWhatActsInThemAndAnUnseenRunsAreItsOwn) {
  expect_found({{0.803, 2.204}}, {{1.752, 3.106}});
}

TEST(Windows, AreFoundWhereTheToolComesIntoTheCutTimeAndAgain) {
  expect_found({{0.603, 1.004}, {1.407, 2.204}, {2.801, 3.607}}, {{0.652, 1.306}, {2.252, 2.906}});
}

// A screw's ripple is a line wherever the axis moves at a steady speed, and stops where it does not.
TEST(Windows, ARippleAtSteadySpeedsIsNoProcessThatCutsThere) {
  const auto nominal = plant::source_axis();
  auto truth = nominal;
  truth.effects = {tests::effect("rev_ripple", {{"amplitude_N", 30.0}, {"cycles_per_rev", 4.7}})};
  const auto run = [&](const plant::AxisParameters& axis, unsigned seed) {
    return tests::make_recording(
        axis,
        {.motion = "triangle", .settings = {.amplitude_m = 0.03, .speed_m_per_s = 0.07}, .duration_s = 4.0, .seed = seed});
  };
  const InverseModel calm(make_tracks({run(nominal, 1), run(nominal, 2)}, nominal), nominal);
  const auto whitening = Whitening::estimate(calm, calm.residual(nominal, {}));
  const InverseModel model(make_tracks({run(truth, 3), run(truth, 4)}, nominal), nominal);
  const Fitter fitter(model, nominal);
  const Fit fit = fitter.fit({nominal, {}}, whitening, 4);
  const Vector white = whitening.applied(model, model.residual(fit.model.axis, {}));
  const double ripple_Hz = 4.7 * 0.07 / nominal.axis.lead_m;
  const auto windows = windows_of_line(model, white, ripple_Hz);
  ASSERT_FALSE(std::ranges::all_of(windows, &Windows::empty)) << "a line in the flats, at " << ripple_Hz;
  const auto scores = screen(fitter, fit, whitening).scores;
  const auto score = std::ranges::find(scores, &hypothesis("process_force"), &Score::hypothesis);
  ASSERT_NE(score, scores.end());
  EXPECT_FALSE(windowed(score->hypothesis->first_window, score->q));
}

// The law of the inverse model, handed to the plant run by run.
TEST(Windows, AreEachRunsOwnInTheClosedLoop) {
  const Windows first{{0.803, 1.204}, {1.607, 2.204}}, second{{1.752, 3.106}};
  const Cut made(first, second);
  Active process{&hypothesis("process_force"), {}};
  for (const double phase_rad : {0.4, 1.9, 0.4, 0.4})
    for (const double part : {std::cos(phase_rad), std::sin(phase_rad)}) process.q.push_back(amplitude_N * part);
  for (const double number : {frequency_Hz, mean_N, opposing_N}) process.q.push_back(number);
  process.q.resize(process.hypothesis->parameters.size(), 0.0);
  set_windows(process.hypothesis->first_window, process.q, std::vector{first, second});
  const ForwardModel simulated(made.data.fit, made.data);
  const auto error = [&](const Candidate& model) { return simulated.nrmse(extended(model)).at("torque_cmd_Nm"); };
  EXPECT_LT(error({made.nominal, {process}}), 0.15 * error({made.nominal, {}}));
  set_windows(process.hypothesis->first_window, process.q, std::vector{second, first});
  EXPECT_GT(error({made.nominal, {process}}), error({made.nominal, {}})) << "the wrong way about";
}

// The axis that is handed on cuts where the first run did; on a run that was not fitted it cuts where that one does.
TEST(Windows, OfAnAxisThatWasHandedOnGiveWayToThoseOfTheRun) {
  const Windows first{{0.8, 1.2}, {1.6, 2.2}, {2.6, 3.0}}, unseen{{1.7, 3.1}};
  Active process{&hypothesis("process_force"), std::vector(hypothesis("process_force").parameters.size(), 0.0)};
  process.q[0] = amplitude_N, process.q[2 * line_runs] = frequency_Hz;
  set_windows(process.hypothesis->first_window, process.q, std::vector<Windows>{first});
  const plant::AxisParameters handed_on = extended({plant::source_axis(), {process}}).common;
  EXPECT_EQ(handed_on.effects.size(), first.size());
  set_windows(process.hypothesis->first_window, process.q, std::vector<Windows>{unseen});
  const AxisByRun axis = with_phases_of({plant::source_axis(), {process}}, handed_on);
  ASSERT_EQ(axis.of(0).effects.size(), 1U);
  const auto& entry = *plant::find_effect("process_force");
  auto cut = axis.of(0).effects.front();
  EXPECT_EQ(*plant::value_in(cut, entry, "start_s"), unseen[0].start_s);
  EXPECT_EQ(*plant::value_in(cut, entry, "end_s"), unseen[0].end_s);
}

TEST(Windows, AreNoneWhereTheProcessNeverStops) {
  const Cut made({{0.0, 1e9}}, {{0.0, 1e9}});
  const Fit fit = made.fitter.fit({made.nominal, {}}, made.whitening, 4);
  const Vector white = made.whitening.applied(made.model, made.model.residual(fit.model.axis, {}));
  for (const auto& of_run : windows_of_line(made.model, white, frequency_Hz)) EXPECT_TRUE(of_run.empty());
}

// Found by a line's envelope an edge is some hundredths of a second off; the force itself steps within a few samples.
TEST(Windows, EdgesAreWhereTheForceStepsAndOverWhatItDoes) {
  const Windows truth{{0.653, 1.104}, {1.802, 2.257}, {2.603, 3.107}}, rough{{0.693, 1.064}, {1.842, 2.297}, {2.563, 3.067}};
  const auto nominal = plant::source_axis();
  for (const double ramp_s : {0.0, 0.05}) {
    const InverseModel model(make_tracks({cut(truth, 0.4, ramp_s)}, nominal), nominal);
    const Cuts found = sharpened(model, model.residual(nominal, {}), frequency_Hz, {rough});
    EXPECT_NEAR(found.ramp_s, ramp_s, 0.011);
    ASSERT_EQ(found.windows[0].size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_NEAR(found.windows[0][i].start_s, truth[i].start_s, 0.007) << ramp_s;
      EXPECT_NEAR(found.windows[0][i].end_s, truth[i].end_s, 0.007) << ramp_s;
    }
  }
}

TEST(Windows, AnEdgeThatNothingShowsStays) {
  const auto nominal = plant::source_axis();
  const InverseModel model(make_tracks({cut({}, 0.0)}, nominal), nominal);
  const Windows rough{{0.693, 1.064}};
  const Cuts found = sharpened(model, model.residual(nominal, {}), frequency_Hz, {rough});
  EXPECT_EQ(found.windows[0][0].start_s, rough[0].start_s);
  EXPECT_EQ(found.windows[0][0].end_s, rough[0].end_s);
}

TEST(Windows, WhatLiesInTheFlatsOfTrapeziaIsAtASteadySpeed) {
  Track track;
  track.sample_s = 1e-3, track.size = 4000;
  track.centred_m_per_s = Vector::Constant(track.size, 0.1);
  for (Index k = 1000; k < 2000; ++k) track.centred_m_per_s[k] = 0.1 - 2e-4 * static_cast<double>(k - 1000);  // turns round
  track.centred_m_per_s.tail(2000).setConstant(-0.1);
  const auto share = [&](const Windows& windows) { return share_at_one_speed({track}, std::vector<Windows>{windows}); };
  EXPECT_GT(share(Windows{{0.1, 0.9}, {2.1, 3.9}}), 0.99);
  EXPECT_LT(share(Windows{{1.1, 1.9}}), 0.01);
  EXPECT_NEAR(share(Windows{{0.5, 1.5}}), 0.5, 0.06);
  track.centred_m_per_s.tail(2000).setConstant(-0.05);
  EXPECT_NEAR(share(Windows{{0.1, 0.9}, {2.1, 2.9}}), 0.5, 0.02)
      << "at another speed what repeats along the screw is no line";
}

TEST(Windows, ARampIsHalfBeforeEachEdge) {
  const Vector share = covered(Windows{{0.004, 0.009}}, 0.004, 13, 1e-3);
  const std::vector<double> expected{0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 0.75, 0.5, 0.25, 0.0, 0.0};
  for (Index k = 0; k < share.size(); ++k) EXPECT_NEAR(share[k], expected[static_cast<std::size_t>(k)], 1e-9) << k;
}

TEST(Windows, AShareOfASampleIsCovered) {
  const Vector share = covered(Windows{{0.0012, 0.0030}, {0.0036, 0.0046}}, 0.0, 6, 1e-3);
  const std::vector<double> expected{0.0, 0.3, 1.0, 0.5, 0.9, 0.1};
  for (Index k = 0; k < share.size(); ++k) EXPECT_NEAR(share[k], expected[static_cast<std::size_t>(k)], 1e-9) << k;
}

}  // namespace
}  // namespace feedtwin
