// What holds on seconds that it was not fitted to, and what need not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/made_case.h"
#include "tools/diagnose/hypothesis.h"
#include "tools/diagnose/judge.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

// Nearly all that an amplitude brings is one moment's, which nothing else foretells: the little that it brings to every
// other second does not make up for that.
TEST(OnUnseen, AnAmplitudeOfOneMomentDoesNotHold) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 8.0})}, axis), axis);
  constexpr Index moment = 40, apart = 30;
  Fit with, without;
  with.jacobian = Eigen::MatrixXd::Zero(model.rows(), 1);
  with.jacobian.topRows(moment).setOnes();
  for (Index k = moment; k < model.rows(); k += apart) with.jacobian(k, 0) = 0.02;
  without.jacobian = Eigen::MatrixXd::Zero(model.rows(), 0);
  for (const double elsewhere : {4.0, 80.0}) {  // the size that every other second would have it
    without.white = elsewhere * with.jacobian.col(0);
    without.white.head(moment).setConstant(4.0);
    const double size = with.jacobian.col(0).dot(without.white) / with.jacobian.col(0).squaredNorm();
    with.white = without.white - size * with.jacobian.col(0);
    with.cost = with.white.squaredNorm(), without.cost = without.white.squaredNorm();
    Verdict verdict;
    verdict.gain = without.cost - with.cost;
    const Unseen unseen = on_unseen(model, with, without, hypothesis("regeneration_clipped"), verdict, Bar{});
    if (elsewhere > 4.0) {
      EXPECT_GE(4 * unseen.folds, 3 * Bar{}.folds) << "nearly every second gains";
      EXPECT_LT(unseen.gain, 0.0);
      EXPECT_FALSE(unseen.holds);
    } else {
      EXPECT_GT(unseen.gain, 0.4 * verdict.gain);
    }
  }
}

// A stop that is struck once: no other second foretells its numbers, which is no reason to doubt what leaves hardly
// anything, or strikes far harder than what is left.
TEST(OnUnseen, OneEventHoldsWhereItIsNearlyAllThatWasLeftOrStrikesHard) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 8.0})}, axis), axis);
  constexpr Index moment = 20;
  Fit with, without;
  with.jacobian = Eigen::MatrixXd::Zero(model.rows(), 2);
  for (const Index column : {0, 1})
    with.jacobian.col(column).segment(column * moment, moment).setConstant(1.0 + static_cast<double>(column));
  without.jacobian = Eigen::MatrixXd::Zero(model.rows(), 0);
  without.white = Vector::Zero(model.rows());
  without.white.head(2 * moment).setConstant(50.0);
  Verdict verdict;
  for (const double left : {0.1, 0.3}) {
    without.cost = without.white.squaredNorm(), with.cost = left * without.cost;
    verdict.gain = without.cost - with.cost;
    with.white = std::sqrt(left) * without.white;
    EXPECT_EQ(on_unseen(model, with, without, hypothesis("hard_stop"), verdict, Bar{}).holds, left < 0.2);
    EXPECT_FALSE(on_unseen(model, with, without, hypothesis("backlash"), verdict, Bar{}).holds);
  }
  verdict.strength = 3.0;  // as hard as a stop strikes, beside much else that is left
  EXPECT_TRUE(on_unseen(model, with, without, hypothesis("hard_stop"), verdict, Bar{}).holds);
  EXPECT_FALSE(on_unseen(model, with, without, hypothesis("backlash"), verdict, Bar{}).holds);
}

// What the numbers' own tolerances gain stands in no stretch of the runs: without a name that keeps them near the file's
// every stretch may lose nearly all that the rows have to lose.
TEST(OnUnseen, HoldsEverywhereByWhatTheRowsGain) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 8.0})}, axis), axis);
  Fit with, without;
  with.jacobian = Eigen::MatrixXd::Ones(model.rows(), 1);
  without.jacobian = Eigen::MatrixXd::Zero(model.rows(), 0);
  without.white = Vector::Constant(model.rows(), 1.0);
  with.white = Vector::Zero(model.rows());
  const double in_rows = without.white.squaredNorm();
  for (const double surprise : {-40.0, 0.0, in_rows}) {
    const Verdict all_of_it{.gain = in_rows + std::max(0.0, surprise), .surprise = surprise};
    EXPECT_TRUE(on_unseen(model, with, without, hypothesis("cogging"), all_of_it, Bar{}).everywhere) << surprise;
    const Verdict less{.gain = 2.0 * in_rows + std::max(0.0, surprise), .surprise = surprise};
    EXPECT_FALSE(on_unseen(model, with, without, hypothesis("cogging"), less, Bar{}).everywhere) << surprise;
  }
}

// A process that pauses for a second has nothing to gain there; any other effect acts in every one.
TEST(OnUnseen, AProcessMayRestInOneFold) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 8.0})}, axis), axis);
  const Bar bar;
  Fit with, without;
  with.jacobian = Eigen::MatrixXd::Ones(model.rows(), 1);
  without.jacobian = Eigen::MatrixXd::Zero(model.rows(), 0);
  without.white = Vector::Constant(model.rows(), 3.0);
  for (const auto& s : model.segments()) without.white.segment(s.start, s.size / static_cast<Index>(bar.folds)).setZero();
  with.white = without.white.array() - without.white.mean();
  without.cost = without.white.squaredNorm(), with.cost = with.white.squaredNorm();
  Verdict verdict;
  verdict.gain = without.cost - with.cost;
  const auto told = [&](std::string_view id) { return on_unseen(model, with, without, hypothesis(id), verdict, bar); };
  ASSERT_EQ(told("process_force").folds, bar.folds - 1);
  EXPECT_TRUE(told("process_force").everywhere);
  EXPECT_FALSE(told("cogging").everywhere);
}

// No other stretch foretells a limit that is met once: where it leaves much over it is believed all the same, and where it
// acts all along it must hold on what it was not fitted to.
TEST(OnUnseen, ALimitThatIsMetOnceIsHeldToNoOtherStretch) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 4.0})}, axis), axis);
  const auto& law = hypothesis("torque_saturation");
  const Index rows = model.rows(), in_one_second = static_cast<Index>(1.0 / model.tracks().front().row_s()) - 30;
  for (const bool once : {true, false}) {
    Fit without;
    without.base = {Fitter(model, axis).base().front()};
    without.jacobian = Eigen::MatrixXd::Constant(rows + 1, 1, 1e-3);
    without.white = Vector::Constant(rows + 1, 0.1);
    without.cost = without.white.squaredNorm();
    Fit with = without;
    with.model.effects = {{&law, {1.0, 100.0}}};
    with.jacobian.conservativeResizeLike(Eigen::MatrixXd::Zero(rows + 1, 3));
    with.jacobian.col(1).head(once ? in_one_second : rows).setConstant(10.0);
    Verdict verdict{.gain = 5000.0, .surprise = 0.0, .strength = 1.2};
    EXPECT_EQ(on_unseen(model, with, without, law, verdict, Bar{}).holds, once);
    verdict.gain = 2000.0, verdict.strength = 0.7;
    EXPECT_FALSE(on_unseen(model, with, without, law, verdict, Bar{}).holds);
  }
}

// Two rows that a number puts on the other side of a gap's flank by a hair's breadth say nothing about it elsewhere; what
// acts about a rest alone, a dozen rows or more, does.
TEST(OnUnseen, AFlankOfAGapSaysNothingOfTheNumbers) {
  const auto axis = plant::source_axis();
  const InverseModel model(make_tracks({tests::make_recording(axis, {.motion = "sine", .duration_s = 8.0})}, axis), axis);
  const Bar bar;
  for (const Index flank : {2, 12}) {
    Fit without;
    without.base = {Fitter(model, axis).base().front()};
    without.jacobian = Eigen::MatrixXd::Ones(model.rows(), 1);
    without.white = Vector::Constant(model.rows(), 2.0);
    for (Index k = 0; k < model.rows(); ++k) without.jacobian(k, 0) = k % 2 == 0 ? 1.0 : -0.5;
    Fit with = without;
    with.white.setConstant(0.1);
    with.jacobian.col(0).segment(model.segments().front().start + 40, flank).setConstant(1e4);
    const auto gains = gains_by_fold(model, with, without, bar.folds);
    EXPECT_EQ(std::ranges::min(gains) > 0.0, flank == 2) << flank;
  }
}

}  // namespace
}  // namespace feedtwin
