// What the closed loop knows of an effect's numbers, as a fit has it.

#include "tools/diagnose/forward/unknowns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/diagnose/cogged.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;
using tests::Cogged;

/// Of two runs' sine and cosine.
using Direction = Eigen::Vector4d;

// One amplitude for both runs is known, each one's share of it is not. The engine widens each number's variance by itself,
// so that the two hardly cancel in the sum; what the runs share is held all the same, and the phases are as they were.
TEST(Unknowns, HowRunsShareALineDoesNotWidenItsAmplitude) {
  const Cogged made;
  Active line{&hypothesis("floor_vibration"), std::vector<double>(2 * line_runs + 1, 0.0)};
  line.q = {3.0, 4.0, -6.0, 2.5, 0.0, 0.0, 0.0, 0.0, 20.0};
  const Candidate model{made.data.axis, {line}};
  const Unknowns unknowns(made.fitter, model);
  const auto first = static_cast<Index>(made.fitter.base().size());
  constexpr double deviation = 0.05, of_shares = 50.0, widened = 1.1;

  const std::complex<double> one(3.0, 4.0), other(-6.0, 2.5);
  const double amplitude = std::sqrt(0.5 * (std::norm(one) + std::norm(other)));
  const Direction whole = Direction(3.0, 4.0, -6.0, 2.5) / (2.0 * amplitude);  // slope of the root of the mean square
  Direction shares(3.0 / std::norm(one), 4.0 / std::norm(one), 6.0 / std::norm(other), -2.5 / std::norm(other));
  shares.normalize();
  const Direction turning = Direction(-4.0, 3.0, 0.0, 0.0).normalized();
  Eigen::Matrix4d own = std::pow(deviation, 2) * Eigen::Matrix4d::Identity();
  own += std::pow(of_shares, 2) * shares * shares.transpose();
  own.row(0) *= widened, own.col(0) *= widened;
  Eigen::MatrixXd of_engine = Eigen::MatrixXd::Identity(first + 9, first + 9);
  of_engine.block<4, 4>(first, first) = own;
  const auto deviation_of = [](const Direction& slope, const Eigen::Matrix4d& covariance) {
    return std::sqrt(slope.dot(covariance * slope));
  };
  ASSERT_GT(deviation_of(whole, own), 10.0 * deviation) << "it leaks";

  const Eigen::Matrix4d of_fit = unknowns.as_of_fit(of_engine).block<4, 4>(first, first);
  EXPECT_NEAR(deviation_of(whole, of_fit), deviation * whole.norm(), 0.3 * deviation);
  EXPECT_NEAR(deviation_of(turning, of_fit), deviation, 0.3 * deviation);
}

}  // namespace
}  // namespace feedtwin
