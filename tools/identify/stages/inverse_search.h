#pragma once
// The friction shape of least cost, within bounds. The residuals are large (two contacts and two directions are taken for
// one), so that Gauss and Newton's curvature J' J lacks what the residuals' own adds, and their steps overshoot. A secant
// correction learns it from step to step (Dennis, Gay, Welsch: NL2SOL, ACM TOMS 7, 1981):
//
//   B = J' J + S,   B p = -J' r,   (J' J + S) s = change of J' r over the last step s
//
// Steps stay within a box about the point. One that does not go down makes the box as small as where the slopes at its ends
// say that the lowest point between them lies, for the valleys are narrow and bent; one that keeps its promise widens it.

#include "tools/identify/stages/inverse_projection.h"

namespace feedtwin::tools {

/// Bounds of x, see friction_shape().
struct ShapeBounds {
  Eigen::Vector3d lowest, highest;
};

struct InverseSearch {
  InverseProjection::Point end;
  int passes = 0;  ///< over the record
  bool converged = false;
};

/// @param tolerance relative fall of the cost that a further step would promise at the end
[[nodiscard]] InverseSearch search_shape(const InverseProjection& projection, const ShapeBounds& bounds,
                                         const Eigen::Vector3d& start, double tolerance);

}  // namespace feedtwin::tools
