#include "tools/diagnose/power_structure.h"

#include <algorithm>

#include "tools/linear_systems.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr Index least_rows_a_column = 5;

}  // namespace

PowerStructure::PowerStructure(const InverseModel& model) {
  for (auto& power : rows_of_power(model, Vector::Zero(model.rows())))
    if (power.numbers.rows() >= least_rows_a_column * power.numbers.cols()) rows_ = std::move(power);
}

Vector PowerStructure::part_of(const Vector& residual) const {
  Vector part = Vector::Zero(residual.size());
  if (rows_.after.empty()) return part;
  const Vector y = residual(rows_.after);
  Vector predicted(y.size());
  for (std::size_t f = 0; f <= *std::ranges::max_element(rows_.fold); ++f) {
    std::vector<Index> own, others;
    for (std::size_t i = 0; i < rows_.fold.size(); ++i) (rows_.fold[i] == f ? own : others).push_back(static_cast<Index>(i));
    const Eigen::MatrixXd seen = rows_.numbers(others, Eigen::all);
    Eigen::MatrixXd normal = seen.transpose() * seen;
    normal.diagonal().array() += 1e-9;
    predicted(own) = rows_.numbers(own, Eigen::all) * solved(normal, seen.transpose() * y(others));
  }
  if ((y - predicted).squaredNorm() < y.squaredNorm()) part(rows_.after) = predicted;
  return part;
}

}  // namespace feedtwin::tools::diagnosis
