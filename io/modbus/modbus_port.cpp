#include "io/modbus/modbus_port.h"

#include <arpa/inet.h>

namespace feedtwin::io::modbus {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

std::int64_t time_ns(Settings& settings, std::string_view key, double lowest_s, double highest_s, double preset_s) {
  return static_cast<std::int64_t>(settings.number(key, lowest_s, highest_s, preset_s) * static_cast<double>(ns_per_s));
}

}  // namespace

void ModbusPort::open() {
  if (!server_) server_ = std::make_unique<Server>(settings_, exchange_);
}

void ModbusPort::close() noexcept {
  if (!server_) return;
  last_counters_ = counters();
  server_.reset();
}

std::vector<Counter> ModbusPort::counters() const {
  if (!server_) return last_counters_;
  const Responder& r = server_->responder();
  const Tallies& t = r.tallies();
  const ConnectionTallies& c = server_->connections();
  return {
      {"modbus_requests", "requests answered", t.requests.value()},
      {"modbus_connections", "connections accepted", c.accepted.value()},
      {"modbus_command_changes", "times that a client took command", t.command_changes.value()},
      {"modbus_refused_writes", "writes refused: another client, or another port, was in command", t.refused_writes.value()},
      {"modbus_superseded", "commands that a newer one replaced before a tick came",
       exchange_.requests().superseded().value()},
      {"modbus_clipped_torques", "torque commands beyond 100 % of rated", r.clipped_torques().value()},
      {"modbus_illegal_functions", "requests with a function that is not served", t.illegal_functions.value()},
      {"modbus_illegal_addresses", "requests for registers that don't exist", t.illegal_addresses.value()},
      {"modbus_illegal_values", "requests with a wrong length or number of registers", t.illegal_values.value()},
      {"modbus_malformed_frames", "connections closed because what came was not Modbus TCP", c.malformed.value()},
      {"modbus_slow_requests", "connections closed because a request took too long to come", c.slow.value()},
      {"modbus_unread_replies", "connections closed because the client did not read its replies", t.unread_replies.value()},
      {"modbus_replaced_clients", "silent clients that made room for another one", c.replaced.value()},
      {"modbus_out_of_descriptors", "times that a connection had to wait for a free descriptor", c.no_descriptor.value()},
  };
}

std::unique_ptr<Port> make_modbus_port(Settings& settings, const PortContext& context) {
  ServerSettings s;
  s.address = settings.text("address", s.address);
  if (in_addr parsed{}; inet_pton(AF_INET, s.address.c_str(), &parsed) != 1)
    settings.fail("address", "expected an IPv4 address, found \"" + s.address + "\"");
  s.port = static_cast<int>(settings.integer("port", 0, 65535, s.port));
  s.max_clients = static_cast<int>(settings.integer("max_clients", 1, 1000, s.max_clients));
  s.request_time_ns = time_ns(settings, "request_time_s", 0.01, 3600.0, 1.0);
  s.command_idle_ns = time_ns(settings, "command_idle_s", 0.01, 3600.0, 1.0);
  return std::make_unique<ModbusPort>(s, context);
}

}  // namespace feedtwin::io::modbus
