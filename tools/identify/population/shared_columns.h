#pragma once
// One batch of costs or residuals, a column for each candidate, divided over the processes that mpirun has started.
//
// Every process runs the same search with the same draws; only columns are divided, by whole groups of lanes, and everyone
// then gets all of them. So the answer does not depend on how many there are, to the last bit.

#include <Eigen/Core>
#include <string>

#include "tools/ranks/ranks.h"

namespace feedtwin::tools {

/// Columns [first, second) that this process computes of `columns`, in whole groups of `group`.
[[nodiscard]] std::pair<Eigen::Index, Eigen::Index> own_columns(const Ranks& ranks, Eigen::Index columns,
                                                                Eigen::Index group);

/// Everyone's own columns to everyone. All processes must call it.
void share_columns(const Ranks& ranks, Eigen::MatrixXd& columns, Eigen::Index group);

/// The smallest of everyone's values.
[[nodiscard]] std::size_t smallest_of(const Ranks& ranks, std::size_t value);

/// What went wrong with the first process that something went wrong with; empty where all went well.
[[nodiscard]] std::string first_problem(const Ranks& ranks, const std::string& own_problem);

}  // namespace feedtwin::tools
