#include "tools/identify/contour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/made_case.h"

namespace feedtwin::tools {
namespace {

/// A circle of 20 mm, once round in 4000 rows.
struct Circle {
  std::vector<double> x, y;
  explicit Circle(double radius_m, double lag_rows = 0.0) {
    for (int i = 0; i < 4000; ++i) {
      const double angle = 2.0 * 3.14159265358979 * (i - lag_rows) / 4000.0;
      x.push_back(radius_m * std::cos(angle));
      y.push_back(radius_m * std::sin(angle));
    }
  }
  [[nodiscard]] PlanarPath path() const { return {x, y}; }
};

TEST(ContourError, IsTheDistanceFromThePathNotFromThePoint) {
  const Circle reference(0.02), late(0.02, 30.0), wide(0.02 + 3e-6, 30.0);
  const auto lag = contour_errors_m(reference.path(), late.path()), off = contour_errors_m(reference.path(), wide.path());
  for (std::size_t i = 200; i < lag.size(); ++i) {
    ASSERT_LT(lag[i], 1e-8) << i;  // a late table is on the path all the same: 0.9 mm of tracking error
    ASSERT_NEAR(off[i], 3e-6, 1e-8) << i;
  }
}

TEST(ContourError, LooksOnlyNearbyOnAPathThatCrossesItself) {
  std::vector<double> x, y;
  for (int i = 0; i < 2000; ++i) {  // along x, then back along it 1 um beside
    x.push_back(i < 1000 ? 1e-5 * i : 1e-5 * (1999 - i));
    y.push_back(i < 1000 ? 0.0 : 1e-6);
  }
  std::vector<double> actual = y;
  actual[100] = 1e-6;  // on the way out, where the way back is
  EXPECT_NEAR(contour_errors_m({x, y}, {x, actual}, 50)[100], 1e-6, 1e-12);
}

TEST(ContourError, AnyRandomPathIsNoFurtherThanItsTrackingError) {
  std::mt19937_64 random(81);
  std::normal_distribution<double> unit;
  std::vector<double> x{0.0}, y{0.0}, ax{0.0}, ay{0.0};
  for (int i = 1; i < 3000; ++i) {
    x.push_back(x.back() + 1e-5 * unit(random)), y.push_back(y.back() + 1e-5 * unit(random));
    ax.push_back(x.back() + 2e-6 * unit(random)), ay.push_back(y.back() + 2e-6 * unit(random));
  }
  const auto errors = contour_errors_m({x, y}, {ax, ay});
  for (std::size_t i = 0; i < errors.size(); ++i) ASSERT_LE(errors[i], std::hypot(ax[i] - x[i], ay[i] - y[i]) + 1e-15) << i;
}

TEST(ContourError, OfTwoCasesThatBelongTogether) {
  const auto axis = plant::source_axis();
  Case a;
  a.axis = axis;
  a.fit.push_back(tests::make_recording(axis, {.settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.05}}));
  Case b = a;
  const auto of_a = compare_case(a, axis), of_b = compare_case(b, axis);
  const auto contours = compare_contours(of_a, of_b);
  ASSERT_EQ(contours.size(), 1U);
  // both axes lag alike, along the diagonal: only what overshoots the path's ends is off it
  const double tracking_m = of_a.runs[0].tracking_recorded->peak_m;
  EXPECT_LE(contours[0].recorded.peak_m, std::sqrt(2.0) * tracking_m);
  EXPECT_LT(contours[0].recorded.rms_m, 0.5 * of_a.runs[0].tracking_recorded->rms_m);
  EXPECT_NEAR(contours[0].simulated.rms_m, contours[0].recorded.rms_m, 1e-7);
  b.fit[0].channels.erase("reference_m");
  EXPECT_NE(
      tests::complaint_of([&] { static_cast<void>(compare_contours(of_a, compare_case(b, axis))); }).find("reference_m"),
      std::string::npos);
  EXPECT_NE(tests::complaint_of([&] { static_cast<void>(compare_contours(of_a, {})); }).find("1 and 0 runs"),
            std::string::npos);
}

}  // namespace
}  // namespace feedtwin::tools
