#pragma once
// Which datagrams count: from whom, and in which order. Pure: no socket, no clock. Wait-free.

#include <cstdint>

#include "io/command_right.h"
#include "plant/realtime.h"

namespace feedtwin::io::udp {

/// A peer's IPv4 address and port, in network order.
struct Peer {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  bool operator==(const Peer&) const = default;
};

class Session {
 public:
  enum class Verdict : std::uint8_t { use, duplicate, late, refused };

  explicit Session(std::int64_t command_idle_ns) noexcept : idle_ns_(command_idle_ns), command_(command_idle_ns) {}

  Verdict judge(const Peer& peer, std::uint32_t sequence, std::int64_t now_ns) noexcept FEEDTWIN_REALTIME {
    const bool paused = now_ns - command_.last_write_ns() >= idle_ns_;
    switch (command_.ask(peer, now_ns)) {
      case CommandRight<Peer>::Answer::refused:
        return Verdict::refused;
      case CommandRight<Peer>::Answer::taken:
        return begin(sequence);
      case CommandRight<Peer>::Answer::kept:
        break;
    }
    if (paused) return begin(sequence);
    // distance on the ring of sequence numbers
    const auto ahead = static_cast<std::int32_t>(sequence - wire_sequence_);
    if (ahead == 0) return Verdict::duplicate;
    if (ahead < 0) return Verdict::late;
    lost_ += static_cast<std::uint64_t>(ahead) - 1;
    sequence_ += static_cast<std::uint32_t>(ahead);
    wire_sequence_ = sequence;
    return Verdict::use;
  }

  /// Where replies go; meaningful once sessions() > 0.
  [[nodiscard]] const Peer& commander() const noexcept FEEDTWIN_REALTIME { return command_.holder(); }
  /// Of the last datagram used: as it came, and for the command guard, whom a new session must not look old.
  [[nodiscard]] std::uint32_t wire_sequence() const noexcept FEEDTWIN_REALTIME { return wire_sequence_; }
  [[nodiscard]] std::uint32_t sequence() const noexcept FEEDTWIN_REALTIME { return sequence_; }
  [[nodiscard]] std::uint64_t lost() const noexcept FEEDTWIN_REALTIME { return lost_; }
  [[nodiscard]] std::uint64_t sessions() const noexcept FEEDTWIN_REALTIME { return sessions_; }

 private:
  Verdict begin(std::uint32_t sequence) noexcept FEEDTWIN_REALTIME {
    constexpr std::uint32_t new_start = 0x10000;  // a jump that no loss explains
    ++sessions_;
    sequence_ += new_start;
    wire_sequence_ = sequence;
    return Verdict::use;
  }

  std::int64_t idle_ns_;
  CommandRight<Peer> command_;
  std::uint32_t wire_sequence_ = 0, sequence_ = 0;
  std::uint64_t lost_ = 0, sessions_ = 0;
};

}  // namespace feedtwin::io::udp
