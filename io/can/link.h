#pragma once
// The way to a bus: SocketCAN (socketcan_link.h), or a simulated bus (twin_bus.h).

#include <cstdint>
#include <span>
#include <vector>

#include "io/can/frame.h"
#include "io/port.h"

namespace feedtwin::io::can {

struct ReceivedFrame {
  Frame frame;
  std::int64_t arrival_ns = 0;  ///< on the link's own clock, see now_ns()
};

enum class Sent : std::uint8_t {
  yes,
  later,  ///< no room now; try again
  lost,   ///< the bus is gone; the frame is not to be sent any more
};

/// What ends a wait.
enum class WakeUp : std::uint8_t { frame, call };  // call: of Link::wake(), which `frame` includes

class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;

  /// Set-up; throws PortError.
  virtual void open() = 0;
  virtual void close() noexcept = 0;

  /// The next frame that has come, if any. Never blocks.
  virtual bool receive(ReceivedFrame& frame) noexcept FEEDTWIN_REALTIME = 0;
  virtual Sent send(const Frame& frame) noexcept FEEDTWIN_REALTIME = 0;
  [[nodiscard]] virtual std::int64_t now_ns() noexcept FEEDTWIN_REALTIME = 0;
  /// True once after the link was off the bus and came back.
  virtual bool take_recovery() noexcept FEEDTWIN_REALTIME = 0;

  /// Wait until a frame has come or somebody calls wake(). Not for a tick on a grid. @return false at the given time
  virtual bool wait(std::int64_t until_ns, WakeUp by) noexcept = 0;
  /// End the wait under way, or else the next one. From any thread, the tick too.
  virtual void wake() noexcept FEEDTWIN_REALTIME = 0;
  /// Take only these identifiers from the bus (0xFFFF: none). Set-up, or the supervising thread.
  virtual void listen(std::span<const std::uint16_t> ids) noexcept = 0;
  /// Look after the bus: restart it when it is off. Called every 20 ms or so from the supervising thread.
  virtual void supervise(std::int64_t now_ns) noexcept = 0;
  /// Not on the tick.
  virtual void add_counters(std::vector<Counter>& counters) const = 0;
};

}  // namespace feedtwin::io::can
