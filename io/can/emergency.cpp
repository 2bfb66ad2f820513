#include "io/can/emergency.h"

#include <algorithm>

namespace feedtwin::io::can {
namespace {

/// CiA 301, error register: bit 0 generic, always; 4 communication; 5 device profile; 7 manufacturer.
std::int64_t register_bits(ErrorCode code) noexcept FEEDTWIN_REALTIME {
  switch (static_cast<std::uint16_t>(code) >> 12) {
    case 0x8:
      return 0x11;
    case 0x7:
      return 0x21;
    default:
      return 0x81;
  }
}

}  // namespace

Emergency::Emergency() noexcept
    : error_register_(entry_of(0x1001, 0)),
      history_(entry_of(0x1003, 0)),
      error_code_(entry_of(0x603F, 0)),
      cob_id_(entry_of(0x1014, 0)) {}

void Emergency::raise(ErrorCode code, ObjectValues& objects, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  ++raised_;
  objects.set(error_register_, objects.get(error_register_) | register_bits(code));
  objects.set(error_code_, static_cast<std::int64_t>(code));
  for (int i = error_history; i > 1; --i) objects.set(history_ + i, objects.get(history_ + i - 1));
  objects.set(history_ + 1, static_cast<std::int64_t>(code));
  objects.set(history_, std::min<std::int64_t>(objects.get(history_) + 1, error_history));
  send(code, objects, out);
}

void Emergency::clear(ObjectValues& objects, FrameQueue& out) noexcept FEEDTWIN_REALTIME {
  if (objects.get(error_register_) == 0) return;
  objects.set(error_register_, 0);
  objects.set(error_code_, 0);
  send(ErrorCode::none, objects, out);
}

void Emergency::send(ErrorCode code, const ObjectValues& objects, FrameQueue& out) const noexcept FEEDTWIN_REALTIME {
  Frame frame;
  frame.id = static_cast<std::uint16_t>(objects.get(cob_id_) & largest_id);
  frame.length = 8;
  store(frame, 0, static_cast<std::uint16_t>(code));
  frame.data[2] = static_cast<std::uint8_t>(objects.get(error_register_));
  out.push(frame);
}

}  // namespace feedtwin::io::can
