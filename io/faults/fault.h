#pragma once
// A fault on purpose: what, when, on which axis.

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/port.h"

namespace feedtwin::io::faults {

enum class FaultKind : std::uint8_t {
  lost_command,
  late_command,
  repeated_command,
  corrupted_command,
  dead_a,
  dead_b,
  dead_index,
  swapped_ab,
  lost_counts,
  missing_index,
};

struct KindName {
  FaultKind kind;
  std::string_view name, meaning;
  std::optional<EncoderFault> encoder;  ///< what it does to the lines; none: a fault of the command
};

/// Every kind by its name in the configuration.
inline constexpr KindName kind_names[] = {
    {FaultKind::lost_command, "lost_command", "commands don't arrive", {}},
    {FaultKind::late_command, "late_command", "commands arrive late", {}},
    {FaultKind::repeated_command, "repeated_command", "the last command arrives again", {}},
    {FaultKind::corrupted_command, "corrupted_command", "a bit of the torque command is turned over", {}},
    {FaultKind::dead_a, "dead_a", "line A stays as it is", EncoderFault::dead_a},
    {FaultKind::dead_b, "dead_b", "line B stays as it is", EncoderFault::dead_b},
    {FaultKind::dead_index, "dead_index", "the index line stays as it is", EncoderFault::dead_index},
    {FaultKind::swapped_ab, "swapped_ab", "lines A and B are swapped", EncoderFault::swapped_ab},
    {FaultKind::lost_counts, "lost_counts", "counts are lost, once", EncoderFault::lost_counts},
    {FaultKind::missing_index, "missing_index", "the index does not come", EncoderFault::missing_index},
};

[[nodiscard]] constexpr const KindName& named(FaultKind kind) noexcept FEEDTWIN_REALTIME {
  return kind_names[static_cast<std::size_t>(kind)];
}

struct Fault {
  FaultKind kind{};
  double at_s = 0.0, for_s = 0.0;  ///< of the run's time; it acts in [at, at + for)
  int axis = -1;                   ///< -1: every axis
  double share = 1.0;              ///< of the commands concerned, 0..1
  double delay_s = 0.0;            ///< of a late command
  std::int64_t counts = 0;         ///< that are lost
};

}  // namespace feedtwin::io::faults
