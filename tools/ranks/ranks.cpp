#include "tools/ranks/ranks.h"

#ifdef FEEDTWIN_MPI
#define OMPI_SKIP_MPICXX 1  // the C interface alone: C++ bindings would need a library of their own
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#endif

#include <cstdlib>
#include <numeric>

#include "tools/config/input_error.h"

namespace feedtwin::tools {
namespace {

/// Open MPI's launcher, those that speak PMI or PMIx (Slurm, MPICH).
bool launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

const Ranks& Ranks::world() {
  static const Ranks ranks;
  return ranks;
}

#ifdef FEEDTWIN_MPI

Ranks::Ranks() {
  if (!launched()) return;
  int given = MPI_THREAD_SINGLE;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS || given < MPI_THREAD_FUNNELED) {
    throw InputError("MPI: can't be started");
  }
  started_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  if (started_) MPI_Finalize();
}

std::vector<std::vector<std::byte>> Ranks::gathered(std::span<const std::byte> mine) const {
  if (size_ == 1) return {std::vector<std::byte>(mine.begin(), mine.end())};
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<int> sizes(ranks), from(ranks, 0);
  const int size = static_cast<int>(mine.size());
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::partial_sum(sizes.begin(), sizes.end() - 1, from.begin() + 1);
  std::vector<std::byte> all(static_cast<std::size_t>(from.back() + sizes.back()));
  MPI_Allgatherv(mine.data(), size, MPI_BYTE, all.data(), sizes.data(), from.data(), MPI_BYTE, MPI_COMM_WORLD);
  std::vector<std::vector<std::byte>> parts;
  for (std::size_t i = 0; i < ranks; ++i) {
    const auto begin = all.begin() + from[i];
    parts.emplace_back(begin, begin + sizes[i]);
  }
  return parts;
}

#else

Ranks::Ranks() {
  if (launched()) throw InputError("started by mpirun, but built without MPI (libopenmpi-dev)");
}

Ranks::~Ranks() = default;

std::vector<std::vector<std::byte>> Ranks::gathered(std::span<const std::byte> mine) const {
  return {std::vector<std::byte>(mine.begin(), mine.end())};
}

#endif

std::vector<std::string> Ranks::gathered(const std::string& mine) const {
  std::vector<std::string> texts;
  for (const auto& part : gathered(std::as_bytes(std::span(mine)))) {
    texts.emplace_back(reinterpret_cast<const char*>(part.data()), part.size());
  }
  return texts;
}

}  // namespace feedtwin::tools
