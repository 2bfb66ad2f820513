#include "io/modbus/responder.h"

namespace feedtwin::io::modbus {

Responder::Responder(modbus_t* context, Exchange& exchange, std::int64_t command_idle_ns)
    : context_(context), bank_(exchange), command_(command_idle_ns) {}

void Responder::leave(ClientId client) noexcept {
  if (command_.release(client)) bank_.forget_commands();
}

bool Responder::may_write(ClientId client, std::int64_t now_ns) noexcept {
  if (!bank_.writable()) return false;
  switch (command_.ask(client, now_ns)) {
    case CommandRight<ClientId>::Answer::refused:
      return false;
    case CommandRight<ClientId>::Answer::taken:
      ++tallies_.command_changes;
      bank_.forget_commands();
      break;
    case CommandRight<ClientId>::Answer::kept:
      break;
  }
  return true;
}

void Responder::count(Refusal refusal) noexcept {
  switch (refusal) {
    case Refusal::none:
      break;
    case Refusal::illegal_function:
      ++tallies_.illegal_functions;
      break;
    case Refusal::illegal_address:
      ++tallies_.illegal_addresses;
      break;
    case Refusal::illegal_value:
      ++tallies_.illegal_values;
      break;
    case Refusal::busy:
      ++tallies_.refused_writes;
      break;
  }
}

bool Responder::answer(int socket, ClientId client, std::span<const std::uint8_t> frame, std::int64_t arrival_ns) noexcept {
  ++tallies_.requests;
  Request request = check(frame, bank_.extent());
  const bool writes = request.write.count > 0;
  if (request.refusal == Refusal::none && writes && !may_write(client, arrival_ns)) request.refusal = Refusal::busy;
  count(request.refusal);

  modbus_set_socket(context_, socket);
  int sent = 0;
  if (request.refusal != Refusal::none) {
    sent = modbus_reply_exception(context_, frame.data(), static_cast<unsigned>(request.refusal));
  } else {
    if (writes) bank_.write(request, arrival_ns);  // before the reply, which takes longer
    bank_.refresh(command_.held());
    const auto registers = bank_.registers();
    modbus_mapping_t mapping{};
    mapping.tab_registers = registers.data();
    mapping.nb_registers = static_cast<int>(registers.size());
    mapping.tab_input_registers = registers.data() + mirror_begin;
    mapping.nb_input_registers = static_cast<int>(registers.size()) - mirror_begin;
    // libmodbus stores the same values once more
    sent = modbus_reply(context_, frame.data(), static_cast<int>(frame.size()), &mapping);
  }
  if (sent < 0) ++tallies_.unread_replies;
  return sent >= 0;
}

}  // namespace feedtwin::io::modbus
