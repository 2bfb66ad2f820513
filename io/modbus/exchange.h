#pragma once
// Between the tick and the Modbus server's thread: requests one way, input registers the other, both wait-free.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "io/mailbox.h"
#include "io/modbus/register_map.h"
#include "io/port.h"
#include "io/registry.h"
#include "io/tally.h"

namespace feedtwin::io::modbus {

/// Every axis's newest request, and its number, so that the tick sees which ones are new.
struct RequestImage {
  std::array<AxisRequest, max_axes> request{};
  std::array<std::uint64_t, max_axes> number{};
  MachineRequest machine{};
  std::uint64_t machine_number = 0;
};

using InputImage = std::array<std::uint16_t, std::size_t{max_axes} * input_stride>;

class Exchange {
 public:
  explicit Exchange(const PortContext& context);

  [[nodiscard]] int axes() const noexcept { return axes_; }
  [[nodiscard]] double rated_torque_Nm(std::size_t axis) const noexcept { return rated_torque_Nm_[axis]; }

  // the tick's side
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME;
  /// After receive(), of the same image.
  bool receive_machine(MachineRequest& newest) noexcept FEEDTWIN_REALTIME;
  void send(const TickReport& tick, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME;

  // the server's side
  /// The loop gives out its results here but takes its commands from another port.
  [[nodiscard]] bool only_watched() const noexcept {
    return sends_.load(std::memory_order_relaxed) > 1 && !asked_.load(std::memory_order_relaxed);
  }
  Mailbox<RequestImage>& requests() noexcept { return requests_; }
  Mailbox<InputImage>& inputs() noexcept { return inputs_; }
  /// Commands that a newer one replaced before a tick came.
  [[nodiscard]] const Tally& superseded() const noexcept { return superseded_; }

 private:
  int axes_;
  std::array<double, max_axes> rated_torque_Nm_{};
  std::array<std::uint64_t, max_axes> number_seen_{};
  std::uint64_t machine_number_seen_ = 0;
  Tally superseded_;
  std::atomic<bool> asked_{false};
  std::atomic<std::uint64_t> sends_{0};  ///< the first one comes before the first tick
  Mailbox<RequestImage> requests_;
  Mailbox<InputImage> inputs_;
};

}  // namespace feedtwin::io::modbus
