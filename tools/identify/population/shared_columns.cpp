#include "tools/identify/population/shared_columns.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace feedtwin::tools {
namespace {

using Eigen::Index;

std::pair<Index, Index> columns_of(Index rank, Index ranks, Index columns, Index group) {
  const Index groups = (columns + group - 1) / group;
  const auto edge = [&](Index r) { return std::min(columns, group * (groups * r / ranks)); };
  return {edge(rank), edge(rank + 1)};
}

}  // namespace

std::pair<Index, Index> own_columns(const Ranks& ranks, Index columns, Index group) {
  return columns_of(ranks.rank(), ranks.size(), columns, group);
}

void share_columns(const Ranks& ranks, Eigen::MatrixXd& columns, Index group) {
  if (ranks.size() == 1) return;
  const auto [first, last] = own_columns(ranks, columns.cols(), group);
  const std::span<const double> mine(columns.data() + first * columns.rows(),
                                     static_cast<std::size_t>((last - first) * columns.rows()));
  const auto parts = ranks.gathered(std::as_bytes(mine));
  for (std::size_t r = 0; r < parts.size(); ++r) {
    const Index begin = columns_of(static_cast<Index>(r), ranks.size(), columns.cols(), group).first;
    if (!parts[r].empty()) std::memcpy(columns.data() + begin * columns.rows(), parts[r].data(), parts[r].size());
  }
}

std::size_t smallest_of(const Ranks& ranks, std::size_t value) {
  std::size_t smallest = value;
  for (const auto& part : ranks.gathered(std::as_bytes(std::span(&value, 1)))) {
    std::size_t other = value;
    std::memcpy(&other, part.data(), std::min(part.size(), sizeof other));
    smallest = std::min(smallest, other);
  }
  return smallest;
}

std::string first_problem(const Ranks& ranks, const std::string& own_problem) {
  for (const auto& problem : ranks.gathered(own_problem)) {
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace feedtwin::tools
