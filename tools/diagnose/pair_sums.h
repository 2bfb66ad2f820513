#pragma once
// Least squares of two columns that belong together - sine and cosine, or a mode's place and speed - for many candidates at
// once: their sums over some rows, an entry a candidate.

#include <Eigen/Core>
#include <utility>

namespace feedtwin::tools::diagnosis {

struct PairSums {
  static constexpr double said_zero = 10.0;  ///< as if ten more rows had said zero
  Eigen::ArrayXd ss, sc, cc, sy, cy;

  explicit PairSums(Eigen::Index candidates) {
    for (auto* part : {&ss, &sc, &cc, &sy, &cy}) part->setZero(candidates);
  }
  /// A row: both columns of every candidate, and what they are to explain.
  void add_row(const Eigen::Ref<const Eigen::ArrayXd>& s, const Eigen::Ref<const Eigen::ArrayXd>& c, double y) {
    ss += s * s, sc += s * c, cc += c * c, sy += y * s, cy += y * c;
  }
  void add(const PairSums& other, double sign = 1.0) {
    ss += sign * other.ss, sc += sign * other.sc, cc += sign * other.cc, sy += sign * other.sy, cy += sign * other.cy;
  }
  /// Fall of the squares that each pair brings.
  [[nodiscard]] Eigen::ArrayXd gain() const {
    const Eigen::ArrayXd s = ss + said_zero, c = cc + said_zero;
    return (c * sy * sy - 2.0 * sc * sy * cy + s * cy * cy) / (s * c - sc * sc);
  }
  /// Amplitudes of one.
  [[nodiscard]] std::pair<double, double> at(Eigen::Index i) const {
    const double s = ss[i] + said_zero, c = cc[i] + said_zero, determinant = s * c - sc[i] * sc[i];
    return {(c * sy[i] - sc[i] * cy[i]) / determinant, (s * cy[i] - sc[i] * sy[i]) / determinant};
  }
};

}  // namespace feedtwin::tools::diagnosis
