#include "tools/identify/population/ranks.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <vector>

#ifdef FEEDTWIN_MPI
#include <mpi.h>
#endif

namespace feedtwin::tools {
namespace {

/// mpirun of OpenMPI, MPICH and Slurm's srun say so in the environment.
bool started_by_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace

std::pair<Eigen::Index, Eigen::Index> Ranks::columns_of(int rank, Eigen::Index columns, Eigen::Index group) const {
  const Eigen::Index groups = (columns + group - 1) / group;
  const auto edge = [&](Eigen::Index r) { return std::min(columns, group * (groups * r / size_)); };
  return {edge(rank), edge(rank + 1)};
}

std::pair<Eigen::Index, Eigen::Index> Ranks::own(Eigen::Index columns, Eigen::Index group) const {
  return columns_of(rank_, columns, group);
}

#ifdef FEEDTWIN_MPI

Ranks::Ranks() {
  if (!started_by_mpirun()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  int running = 0;
  MPI_Initialized(&running);
  if (running == 0) return;
  // the others may wait for this process's columns: they must not wait for ever
  if (std::uncaught_exceptions() > 0 && size_ > 1) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Finalize();
}

void Ranks::share(Eigen::MatrixXd& columns, Eigen::Index group) const {
  if (size_ == 1) return;
  std::vector<int> counts, starts;
  for (int r = 0; r < size_; ++r) {
    const auto [first, last] = columns_of(r, columns.cols(), group);
    counts.push_back(static_cast<int>(last - first));
    starts.push_back(static_cast<int>(first));
  }
  MPI_Datatype column{};  // counts of elements would not fit an int
  MPI_Type_contiguous(static_cast<int>(columns.rows()), MPI_DOUBLE, &column);
  MPI_Type_commit(&column);
  MPI_Allgatherv(MPI_IN_PLACE, 0, column, columns.data(), counts.data(), starts.data(), column, MPI_COMM_WORLD);
  MPI_Type_free(&column);
}

int Ranks::smallest(int value) const {
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return value;
}

std::string Ranks::first_problem(const std::string& own_problem) const {
  if (size_ == 1) return own_problem;
  const int speaker = smallest(own_problem.empty() ? size_ : rank_);
  if (speaker == size_) return "";
  auto length = static_cast<unsigned long>(own_problem.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, speaker, MPI_COMM_WORLD);
  std::string problem = own_problem;
  problem.resize(length);
  MPI_Bcast(problem.data(), static_cast<int>(length), MPI_CHAR, speaker, MPI_COMM_WORLD);
  return problem;
}

#else

Ranks::Ranks() {
  if (started_by_mpirun()) throw std::runtime_error("started by mpirun, but built without MPI (libopenmpi-dev)");
}

Ranks::~Ranks() = default;

void Ranks::share(Eigen::MatrixXd& /*columns*/, Eigen::Index /*group*/) const {}

int Ranks::smallest(int value) const {
  return value;
}

std::string Ranks::first_problem(const std::string& own_problem) const {
  return own_problem;
}

#endif

}  // namespace feedtwin::tools
