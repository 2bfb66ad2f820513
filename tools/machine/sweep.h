#pragma once
// A job over a grid of parameter values, on all cores and all MPI ranks, and the law of specific energy over removal rate.

#include <cstddef>
#include <string>
#include <vector>

#include "tools/machine/job.h"
#include "tools/machine/machine_run.h"

namespace feedtwin::tools {

struct SweepAxis {
  std::string key;  ///< of job_keys
  std::vector<double> values;
};

/// "key=from:to:count" or "key=a,b,c". Throws InputError.
[[nodiscard]] SweepAxis read_sweep_axis(const std::string& text);

struct SweepPoint {
  std::vector<double> values;  ///< one an axis
  MachineTotals result;
};

/// Every combination, the last axis fastest. Reports progress on standard error. Under mpirun the ranks share the points,
/// each gets them all, and an error of one is thrown at every one.
[[nodiscard]] std::vector<SweepPoint> run_sweep(const MachineJob& job, const std::vector<SweepAxis>& axes, unsigned threads);

/// SEC = a / MRR + b, least squares in SEC (the source's Eq. 15; Diaz et al. 2011).
struct SpecificEnergyFit {
  double a_W = 0.0, b_J_per_mm3 = 0.0;
  double rms_J_per_mm3 = 0.0;
  std::size_t points = 0;
  [[nodiscard]] double at(double mrr_mm3_per_s) const noexcept { return a_W / mrr_mm3_per_s + b_J_per_mm3; }
};

/// Of the points that removed anything; points is 0 where they have fewer than two removal rates.
[[nodiscard]] SpecificEnergyFit fit_specific_energy(const std::vector<SweepPoint>& points);

}  // namespace feedtwin::tools
