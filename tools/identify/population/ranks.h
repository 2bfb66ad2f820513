#pragma once
// The processes that share a population's work: one, or as many as mpirun has started (built with OpenMPI).
//
// Every process runs the same search with the same draws; only costs are divided, by whole groups of columns, and everyone
// then gets all of them. So the answer does not depend on how many there are. A process that dies ends all (mpirun does so),
// one that throws takes the others with it.

#include <Eigen/Core>
#include <string>

namespace feedtwin::tools {

class Ranks {
 public:
  /// Joins the others. A process that mpirun has not started is alone.
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int size() const noexcept { return size_; }
  /// The one that reads out results.
  [[nodiscard]] bool first() const noexcept { return rank_ == 0; }

  /// Columns [first, second) that this process computes of `columns`, in whole groups of `group`.
  [[nodiscard]] std::pair<Eigen::Index, Eigen::Index> own(Eigen::Index columns, Eigen::Index group) const;
  /// Everyone's own columns to everyone.
  void share(Eigen::MatrixXd& columns, Eigen::Index group) const;
  /// The smallest of everyone's values.
  [[nodiscard]] int smallest(int value) const;

  /// What `action` of this process says went wrong, or that of another; empty where all went well. Everyone must call it.
  [[nodiscard]] std::string first_problem(const std::string& own_problem) const;

 private:
  [[nodiscard]] std::pair<Eigen::Index, Eigen::Index> columns_of(int rank, Eigen::Index columns, Eigen::Index group) const;
  int rank_ = 0, size_ = 1;
};

}  // namespace feedtwin::tools
