#include "io/can/drive_state.h"

namespace feedtwin::io::can {
namespace {

// CiA 402, controlword: bit 0 switch on, 1 enable voltage, 2 quick stop (low), 3 enable operation, 7 fault reset.
constexpr std::uint16_t switch_on = 1, enable_voltage = 2, no_quick_stop = 4, enable_operation = 8, fault_reset = 0x80;
constexpr std::uint16_t resume = switch_on | enable_voltage | no_quick_stop | enable_operation;

}  // namespace

std::uint16_t DriveStateMachine::status_bits() const noexcept FEEDTWIN_REALTIME {
  switch (state_) {
    case Cia402State::switch_on_disabled:
      return 0x40;
    case Cia402State::ready_to_switch_on:
      return 0x21;
    case Cia402State::switched_on:
      return 0x23;
    case Cia402State::operation_enabled:
      return 0x27;
    case Cia402State::quick_stop_active:
      return 0x07;
    case Cia402State::fault_reaction_active:
      return 0x0F;
    case Cia402State::fault:
      return 0x08;
  }
  return 0x08;
}

bool DriveStateMachine::step(std::uint16_t controlword, bool standstill,
                             const StopOptions& options) noexcept FEEDTWIN_REALTIME {
  const bool reset = (controlword & ~last_controlword_ & fault_reset) != 0;
  last_controlword_ = controlword;
  switch (state_) {
    case Cia402State::fault:
      if (reset) state_ = Cia402State::switch_on_disabled;
      return reset;
    case Cia402State::fault_reaction_active:
      if (standstill) state_ = Cia402State::fault;
      return false;
    case Cia402State::quick_stop_active:
      if ((controlword & (enable_voltage | fault_reset)) == 0 || (standstill && !stays(options))) {
        state_ = Cia402State::switch_on_disabled;
      } else if (stays(options) && (controlword & (resume | fault_reset)) == resume) {
        state_ = Cia402State::operation_enabled;
      }
      return false;
    default:
      obey(controlword, options);
      return false;
  }
}

void DriveStateMachine::obey(std::uint16_t controlword, const StopOptions& options) noexcept FEEDTWIN_REALTIME {
  using enum Cia402State;
  if ((controlword & fault_reset) != 0) return;  // no command is valid with it
  if ((controlword & enable_voltage) == 0) {
    state_ = switch_on_disabled;
    return;
  }
  if ((controlword & no_quick_stop) == 0) {
    state_ = state_ == operation_enabled && options.quick_stop != 0 ? quick_stop_active : switch_on_disabled;
    return;
  }
  if (state_ == switch_on_disabled) {  // only shutdown leaves it
    if ((controlword & switch_on) == 0) state_ = ready_to_switch_on;
  } else if ((controlword & switch_on) == 0) {
    state_ = ready_to_switch_on;
  } else if (state_ == ready_to_switch_on) {
    state_ = switched_on;
  } else {
    state_ = (controlword & enable_operation) != 0 ? operation_enabled : switched_on;
  }
}

void DriveStateMachine::fault(const StopOptions& options) noexcept FEEDTWIN_REALTIME {
  if (state_ == Cia402State::fault || state_ == Cia402State::fault_reaction_active) return;
  const bool torque = state_ == Cia402State::operation_enabled || state_ == Cia402State::quick_stop_active;
  state_ = torque && options.fault_reaction == 2 ? Cia402State::fault_reaction_active : Cia402State::fault;
}

void DriveStateMachine::disable() noexcept FEEDTWIN_REALTIME {
  if (state_ != Cia402State::fault && state_ != Cia402State::fault_reaction_active) state_ = Cia402State::switch_on_disabled;
}

void DriveStateMachine::quick_stop() noexcept FEEDTWIN_REALTIME {
  if (state_ == Cia402State::operation_enabled) state_ = Cia402State::quick_stop_active;
}

}  // namespace feedtwin::io::can
