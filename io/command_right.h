#pragma once
// Of several clients one is in command: the first to write. The others may read.

#include <cstdint>

#include "plant/realtime.h"

namespace feedtwin::io {

/// Who is in command, until he leaves or has not written for the idle time while another one wants to. Wait-free.
template <class Client>
class CommandRight {
 public:
  enum class Answer : std::uint8_t { refused, kept, taken };

  explicit CommandRight(std::int64_t idle_ns) noexcept : idle_ns_(idle_ns) {}

  /// `who` wants to write now. `taken`: he was not in command before.
  Answer ask(const Client& who, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
    if (held_by(who)) {
      last_write_ns_ = now_ns;
      return Answer::kept;
    }
    if (held_ && now_ns - last_write_ns_ < idle_ns_) return Answer::refused;
    holder_ = who;
    held_ = true;
    last_write_ns_ = now_ns;
    return Answer::taken;
  }
  /// `who` has gone. @return true if he was in command
  bool release(const Client& who) noexcept FEEDTWIN_REALTIME {
    if (!held_by(who)) return false;
    held_ = false;
    return true;
  }
  [[nodiscard]] bool held() const noexcept FEEDTWIN_REALTIME { return held_; }
  [[nodiscard]] bool held_by(const Client& who) const noexcept FEEDTWIN_REALTIME { return held_ && holder_ == who; }
  /// The one in command, or the last one who was.
  [[nodiscard]] const Client& holder() const noexcept FEEDTWIN_REALTIME { return holder_; }
  /// When the holder last wrote (or, after a release, its last one did).
  [[nodiscard]] std::int64_t last_write_ns() const noexcept FEEDTWIN_REALTIME { return last_write_ns_; }

 private:
  std::int64_t idle_ns_;
  std::int64_t last_write_ns_ = 0;
  Client holder_{};
  bool held_ = false;
};

}  // namespace feedtwin::io
