#pragma once
// Modbus TCP as a port of the plant: the register map of register_map.h, served by server.h.

#include <memory>

#include "io/modbus/exchange.h"
#include "io/modbus/server.h"
#include "io/port.h"
#include "io/registry.h"

namespace feedtwin::io::modbus {

class ModbusPort final : public Port {
 public:
  ModbusPort(const ServerSettings& settings, const PortContext& context) : settings_(settings), exchange_(context) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "modbus"; }
  void open() override;
  void close() noexcept override;
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override {
    return exchange_.requests().receive(newest);
  }
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME override {
    return exchange_.requests().receive_machine(newest);
  }
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override {
    exchange_.send(tick, axes);
  }
  [[nodiscard]] std::vector<Counter> counters() const override;

  /// The TCP port that is served; 0 before open().
  [[nodiscard]] int tcp_port() const noexcept { return server_ ? server_->port() : 0; }

 private:
  ServerSettings settings_;
  Exchange exchange_;
  std::unique_ptr<Server> server_;
  std::vector<Counter> last_counters_;  ///< of a server that has been closed
};

std::unique_ptr<Port> make_modbus_port(Settings& settings, const PortContext& context);

}  // namespace feedtwin::io::modbus
