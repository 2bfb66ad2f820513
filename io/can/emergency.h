#pragma once
// EMCY of CiA 301: what went wrong, on the bus, in the error register and in the history of object 1003.

#include <cstdint>

#include "io/can/frame.h"
#include "io/can/object_values.h"

namespace feedtwin::io::can {

enum class ErrorCode : std::uint16_t {
  none = 0x0000,
  encoder = 0x7305,        ///< incremental sensor 1
  communication = 0x8100,  ///< the master took the node out of operation
  heartbeat = 0x8130,
  bus_off_recovered = 0x8140,
  pdo_length = 0x8210,    ///< too short, not used
  rpdo_timeout = 0x8250,  ///< no command for too long
  guard = 0xFF01,         ///< the plant server's own watchdog took the torque away
};

class Emergency {
 public:
  Emergency() noexcept;

  /// Records the error and queues its frame. Wait-free.
  void raise(ErrorCode code, ObjectValues& objects, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  /// All errors are gone: error register 0, EMCY 0000.
  void clear(ObjectValues& objects, FrameQueue& out) noexcept FEEDTWIN_REALTIME;
  [[nodiscard]] std::uint64_t raised() const noexcept { return raised_; }

 private:
  void send(ErrorCode code, const ObjectValues& objects, FrameQueue& out) const noexcept FEEDTWIN_REALTIME;

  int error_register_, history_, error_code_, cob_id_;  // entries of the table
  std::uint64_t raised_ = 0;
};

}  // namespace feedtwin::io::can
