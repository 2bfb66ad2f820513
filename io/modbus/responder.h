#pragma once
// Answers one request after another: who may write, what is stored, and libmodbus for the reply itself.

#include <modbus.h>

#include <cstdint>
#include <memory>
#include <span>

#include "io/command_right.h"
#include "io/modbus/register_bank.h"
#include "io/modbus/request.h"
#include "io/tally.h"

namespace feedtwin::io::modbus {

using ClientId = std::uint64_t;

struct Tallies {
  Tally requests, illegal_functions, illegal_addresses, illegal_values, refused_writes, command_changes, unread_replies;
};

class Responder {
 public:
  /// @param context libmodbus's, for TCP; must outlive this
  Responder(modbus_t* context, Exchange& exchange, std::int64_t command_idle_ns);

  /// Answer a whole frame. @param socket non-blocking @return false: the client does not read its replies, leave it
  bool answer(int socket, ClientId client, std::span<const std::uint8_t> frame, std::int64_t arrival_ns) noexcept;
  /// The client has gone.
  void leave(ClientId client) noexcept;

  [[nodiscard]] bool in_command(ClientId client) const noexcept { return command_.held_by(client); }
  [[nodiscard]] const Tallies& tallies() const noexcept { return tallies_; }
  [[nodiscard]] const Tally& clipped_torques() const noexcept { return bank_.clipped_torques(); }

 private:
  [[nodiscard]] bool may_write(ClientId client, std::int64_t now_ns) noexcept;
  void count(Refusal refusal) noexcept;

  modbus_t* context_;
  RegisterBank bank_;
  CommandRight<ClientId> command_;
  Tallies tallies_;
};

}  // namespace feedtwin::io::modbus
