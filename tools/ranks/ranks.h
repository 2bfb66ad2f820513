#pragma once
// The processes that work on one job together: `mpirun -n 4 build/release/feedtwin ...`. Without a launcher there is one,
// and MPI is not even started.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace feedtwin::tools {

class Ranks {
 public:
  /// Those of this program; the first call starts MPI where a launcher has said that there are several.
  static const Ranks& world();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const noexcept { return rank_; }
  [[nodiscard]] int size() const noexcept { return size_; }
  /// The one that prints and writes files.
  [[nodiscard]] bool first() const noexcept { return rank_ == 0; }

  /// What every rank gives, at every rank, in the order of the ranks. All ranks must call it.
  [[nodiscard]] std::vector<std::vector<std::byte>> gathered(std::span<const std::byte> mine) const;
  [[nodiscard]] std::vector<std::string> gathered(const std::string& mine) const;

 private:
  Ranks();
  int rank_ = 0, size_ = 1;
  bool started_ = false;
};

}  // namespace feedtwin::tools
