#include "plant/machine/workpiece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace feedtwin::plant {
namespace {

using std::numbers::pi;
constexpr BlockParameters block{-0.05, 0.05, -0.05, 0.05, 0.0};
constexpr double R = 2e-3;

TEST(Workpiece, ASlotIsFullImmersion) {
  Workpiece piece(block, R);
  piece.clear(0, 0, 0.01, 0, -1e-3);
  const auto e = piece.engagement(0.01, 0, -1e-3, 0.0);
  ASSERT_EQ(e.count, 1);
  EXPECT_NEAR(e.immersions[0].entry_rad, 0.0, 1e-9);
  EXPECT_NEAR(e.immersions[0].exit_rad, pi, 1e-9);
  EXPECT_NEAR(e.immersions[0].depth_m, 1e-3, 1e-15);
}

TEST(Workpiece, ASideCutMeetsTheMaterialOnItsSideAlone) {
  // a pass beside a slot, stepped over to the left by `width`: the right part of the way is already cleared
  Workpiece piece(block, R);
  piece.clear(-0.03, 0, 0.03, 0, -1e-3);
  for (const double width : {0.5e-3, 1e-3, 2e-3, 3.5e-3}) {
    const auto e = piece.engagement(0, width, -1e-3, 0.0);
    ASSERT_EQ(e.count, 1) << width;
    // the wall of the slot is at y = R: cos(phi) = (R - width) / R from the left
    EXPECT_NEAR(e.immersions[0].entry_rad, 0.0, 1e-9);
    EXPECT_NEAR(e.immersions[0].exit_rad, std::acos((R - width) / R), 2e-5) << width;
  }
}

TEST(Workpiece, FacesOfTheBlockBoundTheCut) {
  Workpiece piece(block, R);
  const auto outside = piece.engagement(-0.05 - 1.001 * R, 0, -1e-3, 0.0);
  EXPECT_EQ(outside.count, 0);
  const auto entering = piece.engagement(-0.05 - 0.5 * R, 0, -1e-3, 0.0);
  ASSERT_EQ(entering.count, 1);
  EXPECT_NEAR(entering.immersions[0].entry_rad, pi / 2 - pi / 3, 2e-5);
  EXPECT_NEAR(entering.immersions[0].exit_rad, pi / 2 + pi / 3, 2e-5);
  const auto along_edge = piece.engagement(0, 0.05, -1e-3, 0.0);  // half of the tool stands over the left face
  ASSERT_EQ(along_edge.count, 1);
  EXPECT_NEAR(along_edge.immersions[0].entry_rad, pi / 2, 2e-5);
}

TEST(Workpiece, DepthIsWhatStandsAboveTheTip) {
  Workpiece piece(block, R);
  piece.clear(-0.03, R, 0.03, R, -0.4e-3);  // a shallow pass, its edge along y = 0
  const auto e = piece.engagement(0, 0, -1e-3, 0.0);
  ASSERT_EQ(e.count, 2);
  EXPECT_NEAR(e.immersions[0].exit_rad, pi / 2, 2e-5);
  EXPECT_NEAR(e.immersions[0].depth_m, 0.6e-3, 1e-12);
  EXPECT_NEAR(e.immersions[1].depth_m, 1e-3, 1e-12);
  EXPECT_EQ(piece.engagement(0, 0, 0.0, 0.0).count, 0) << "above the block";
}

TEST(Workpiece, APocketIsRemovedWhole) {
  // zigzag over a square; the volume by engagement is that of the union of the passes
  Workpiece piece(block, R);
  const double depth = 1e-3, stepover = 1.5e-3, half = 8e-3, ds = 0.02e-3;
  double volume = 0.0;
  double x = -half, y = -half;
  const auto go = [&](double to_x, double to_y) {
    const double length = std::hypot(to_x - x, to_y - y), heading = std::atan2(to_y - y, to_x - x);
    const int n = static_cast<int>(std::round(length / ds));
    for (int i = 0; i < n; ++i) {
      const double nx = x + (to_x - x) / (n - i), ny = y + (to_y - y) / (n - i);
      const auto e = piece.engagement(0.5 * (x + nx), 0.5 * (y + ny), -depth, heading);
      for (int k = 0; k < e.count; ++k) {
        const auto& im = e.immersions[static_cast<std::size_t>(k)];
        volume += im.depth_m * R * (std::cos(im.entry_rad) - std::cos(im.exit_rad)) * length / n;
      }
      piece.clear(x, y, nx, ny, -depth);
      x = nx;
      y = ny;
    }
  };
  piece.clear(x, y, x, y, -depth);  // plunge
  const double plunge = depth * pi * R * R;
  for (int row = 0; row < 10; ++row) {
    go(row % 2 == 0 ? half : -half, y);
    go(x, y + stepover);
  }
  const double top = -half + 10 * stepover;
  // all of it: the last short pass goes on beyond the rows at one side only
  const double rows = 2 * half * (9 * stepover + 2 * R) + 2 * R * 9 * stepover + pi * R * R;
  const double corners = volume + plunge;
  EXPECT_NEAR(corners, depth * (rows + 2 * R * stepover), 0.02 * depth * rows) << top;
}

}  // namespace
}  // namespace feedtwin::plant
