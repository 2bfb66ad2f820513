#pragma once
// The state machine of CiA 402: controlword in, statusword out.

#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io::can {

enum class Cia402State : std::uint8_t {
  switch_on_disabled,
  ready_to_switch_on,
  switched_on,
  operation_enabled,
  quick_stop_active,
  fault_reaction_active,
  fault,
};

/// Bits of the statusword that do not come from the state.
namespace status {
inline constexpr std::uint16_t voltage_enabled = 1U << 4;
inline constexpr std::uint16_t remote = 1U << 9;
inline constexpr std::uint16_t internal_limit = 1U << 11;
inline constexpr std::uint16_t follows_command = 1U << 12;
}  // namespace status

/// How a drive stops: objects 605A (quick stop), 605E (fault).
struct StopOptions {
  /// 0: switch-on disabled at once, the axis coasts; 2: brake along the ramp of 6085; 3: with all the torque of 6072; at
  /// standstill switch-on disabled. 6, 7: as 2 and 3, but stay in quick stop
  int quick_stop = 2;
  int fault_reaction = 0;  ///< 0: torque off at once; 2: as a quick stop, then torque off
};

class DriveStateMachine {
 public:
  [[nodiscard]] Cia402State state() const noexcept FEEDTWIN_REALTIME { return state_; }
  [[nodiscard]] bool operating() const noexcept FEEDTWIN_REALTIME { return state_ == Cia402State::operation_enabled; }
  [[nodiscard]] bool braking() const noexcept FEEDTWIN_REALTIME {
    return state_ == Cia402State::quick_stop_active || state_ == Cia402State::fault_reaction_active;
  }
  /// The state's own bits of the statusword.
  [[nodiscard]] std::uint16_t status_bits() const noexcept FEEDTWIN_REALTIME;

  /// One transition at most. A fault is reset by the rising edge of bit 7. Wait-free.
  /// @return true on a fault reset.
  bool step(std::uint16_t controlword, bool standstill, const StopOptions& options) noexcept FEEDTWIN_REALTIME;
  /// Something went wrong: to fault, by way of the fault reaction where there is torque to take away.
  void fault(const StopOptions& options) noexcept FEEDTWIN_REALTIME;
  void disable() noexcept FEEDTWIN_REALTIME;
  void quick_stop() noexcept FEEDTWIN_REALTIME;
  /// Whether a standing drive is to stay in quick stop.
  [[nodiscard]] static bool stays(const StopOptions& options) noexcept FEEDTWIN_REALTIME { return options.quick_stop >= 5; }
  void reset() noexcept FEEDTWIN_REALTIME { *this = {}; }

 private:
  void obey(std::uint16_t controlword, const StopOptions& options) noexcept FEEDTWIN_REALTIME;

  Cia402State state_ = Cia402State::switch_on_disabled;
  std::uint16_t last_controlword_ = 0;
};

}  // namespace feedtwin::io::can
