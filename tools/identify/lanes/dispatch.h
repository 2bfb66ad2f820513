#pragma once
// Closed-loop simulation of many parameter sets: in lanes of the widest vectors that this processor has, on all its cores.

#include <span>
#include <vector>

#include "tools/identify/lanes/kernel.h"

namespace feedtwin::tools::lanes {

/// Every kernel that this processor can run, slowest first.
[[nodiscard]] std::vector<KernelEntry> usable_kernels();
/// The widest one, or the one that use_no_wider_than() left.
[[nodiscard]] KernelEntry best_kernel();
/// For processes that must agree to the last bit: the widest kernel that all of them have. Set-up only.
void use_no_wider_than(std::size_t width) noexcept;

/// Which results a simulation is asked for.
struct Wanted {
  bool torque = true, position = false, torque_sensor = false, force_sensor = false, power = false;
};

/// Results of one candidate; empty where not wanted. Meanings as in Outputs.
struct CandidateResult {
  std::vector<double> torque_Nm, position_m, torque_sensor_Nm, force_sensor_N, power_W;
  /// Never of the lanes: scale, since their table is rigid; power at the instant at which the tick's command sets in, which
  /// is what a meter sees that samples with the controller.
  std::vector<double> scale_position_m, instant_power_W;
};

/// All candidates on one record, in their order, with `threads` threads (0: one a core).
[[nodiscard]] std::vector<CandidateResult> simulate_candidates(const RecordView& record,
                                                               std::span<const Candidate> candidates, const Wanted& wanted,
                                                               unsigned threads = 0);

}  // namespace feedtwin::tools::lanes
