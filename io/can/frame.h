#pragma once
// A classical CAN data or remote frame with an 11-bit identifier, and a bounded queue of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "plant/realtime.h"

namespace feedtwin::io::can {

inline constexpr std::uint32_t largest_id = 0x7FF;

struct Frame {
  std::uint16_t id = 0;
  std::uint8_t length = 0;  ///< 0..8
  bool remote = false;
  std::array<std::uint8_t, 8> data{};

  friend bool operator==(const Frame&, const Frame&) = default;
};

/// Little-endian, as CANopen and ODrive have it. T: an integer or a float; at + sizeof(T) <= 8.
template <class T>
[[nodiscard]] T load(const Frame& frame, std::size_t at) noexcept FEEDTWIN_REALTIME {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(&value, frame.data.data() + at, sizeof(T));
  return value;
}
template <class T>
void store(Frame& frame, std::size_t at, T value) noexcept FEEDTWIN_REALTIME {
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(frame.data.data() + at, &value, sizeof(T));
}

/// First in, first out, no allocation. Full: push() refuses and counts.
class FrameQueue {
 public:
  static constexpr std::size_t capacity = 256;

  bool push(const Frame& frame) noexcept FEEDTWIN_REALTIME {
    if (size_ == capacity) {
      ++refused_;
      return false;
    }
    frames_[(first_ + size_) % capacity] = frame;
    ++size_;
    return true;
  }
  /// Put the frame in the place of one with the same identifier. @return false if there is none
  bool replace(const Frame& frame) noexcept FEEDTWIN_REALTIME {
    for (std::size_t i = 0; i < size_; ++i) {
      Frame& there = frames_[(first_ + i) % capacity];
      if (there.id != frame.id) continue;
      there = frame;
      return true;
    }
    return false;
  }
  [[nodiscard]] bool empty() const noexcept FEEDTWIN_REALTIME { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept FEEDTWIN_REALTIME { return size_; }
  [[nodiscard]] const Frame& front() const noexcept FEEDTWIN_REALTIME { return frames_[first_]; }
  void pop() noexcept FEEDTWIN_REALTIME {
    first_ = (first_ + 1) % capacity;
    --size_;
  }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  std::array<Frame, capacity> frames_{};
  std::size_t first_ = 0, size_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace feedtwin::io::can
