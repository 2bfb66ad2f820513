#pragma once
// The friction shape of least cost, within bounds, by Gauss and Newton's steps
//
//   J' J p = -J' r
//
// of which each stays within a box about the point. The residuals are large (two contacts and two directions are taken for
// one) and the valleys narrow and bent, so that a step often goes too far: one that does not go down makes the box as small
// as where the slopes at its ends say that the lowest point between them lies; one that keeps its promise widens it. Within
// bounds and box the step is exact.

#include "tools/identify/stages/inverse_projection.h"

namespace feedtwin::tools {

/// Bounds of x, see friction_shape().
struct ShapeBounds {
  Eigen::Vector3d lowest, highest;
};

struct InverseSearch {
  InverseProjection::Point end;
  int passes = 0;  ///< over the record
};

/// @param tolerance half the relative fall of the cost that a further step would promise at the end
[[nodiscard]] InverseSearch search_shape(const InverseProjection& projection, const ShapeBounds& bounds,
                                         const Eigen::Vector3d& start, double tolerance);

}  // namespace feedtwin::tools
