#pragma once
// What an encoder's rounding does to a fit. Where the axis rests, the stand-in holds the simulated axis at the count that
// was recorded instead of where it was: in pre-sliding a count is newtons, in every sensor, for as long as the rest lasts,
// and again in the next lap. No residual's short-time statistics can know of that, but a simulation can: the fitted axis is
// taken for the true one, recorded through grids that stand anywhere, and what each grid moves the fit by is seen (a
// parametric bootstrap of one Gauss-Newton step).

#include <Eigen/Core>

#include "tools/identify/least_squares.h"
#include "tools/identify/residual_stack.h"

namespace feedtwin::tools {

/// Mean squares and products of what the encoder's rounding moves the unknowns by. About zero: a mean is not taken off the
/// fit, so it counts as error.
/// @param inverse of the information at the solution; @param grids tried
/// Zeros with fewer than two, and where a controller takes the stand-in's place: that one acts on what it reads, grid and
/// all.
[[nodiscard]] Eigen::MatrixXd rounding_effect(const LeastSquaresSolution& at, const Eigen::MatrixXd& inverse,
                                              const ResidualStack& stack, int grids);

}  // namespace feedtwin::tools
