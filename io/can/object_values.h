#pragma once
// The values of one drive's objects.

#include <array>
#include <cstdint>
#include <span>

#include "io/can/object_dictionary.h"

namespace feedtwin::io::can {

/// CiA 301, SDO abort codes; ok where nothing is wrong.
enum class Abort : std::uint32_t {
  ok = 0,
  toggle = 0x0503'0000,
  timeout = 0x0504'0000,
  command = 0x0504'0001,
  unsupported_access = 0x0601'0000,
  read_only = 0x0601'0002,
  sub_0_first = 0x0601'0003,
  no_object = 0x0602'0000,
  not_mappable = 0x0604'0041,
  pdo_too_long = 0x0604'0042,
  length = 0x0607'0010,
  too_long = 0x0607'0012,
  too_short = 0x0607'0013,
  no_sub = 0x0609'0011,
  value = 0x0609'0030,
  too_high = 0x0609'0031,
  too_low = 0x0609'0032,
  state = 0x0800'0022,
};

/// What differs from axis to axis.
struct DriveIdentity {
  std::uint8_t node_id = 1;
  double rated_torque_Nm = 1.27;
  double encoder_counts_per_rev = 65536.0;
  double lead_m = 0.005;
};

/// A default as this drive has it.
[[nodiscard]] std::int64_t preset_of(const ObjectEntry& entry, const DriveIdentity& drive) noexcept FEEDTWIN_REALTIME;

class ObjectValues {
 public:
  explicit ObjectValues(const DriveIdentity& drive) noexcept { reset(drive); }

  /// Every object of first..last to its default. Wait-free.
  void reset(const DriveIdentity& drive, std::uint16_t first = 0, std::uint16_t last = 0xFFFF) noexcept FEEDTWIN_REALTIME;

  [[nodiscard]] std::int64_t get(int entry) const noexcept FEEDTWIN_REALTIME {
    return values_[static_cast<std::size_t>(entry)];
  }
  void set(int entry, std::int64_t value) noexcept FEEDTWIN_REALTIME { values_[static_cast<std::size_t>(entry)] = value; }

  /// The entry as bytes on the wire, little-endian; returns how many. `bytes` holds at least longest_text.
  [[nodiscard]] std::size_t encode(int entry, std::span<std::uint8_t> bytes) const noexcept FEEDTWIN_REALTIME;
  /// A number from the wire, sign extended. `bytes` has the type's length.
  [[nodiscard]] static std::int64_t decode(DataType type, std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME;
  /// Ok if bytes are of the right length and within the entry's limits.
  [[nodiscard]] static Abort check(const ObjectEntry& entry, std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME;
  /// Takes the one writable text.
  void set_label(std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME;

 private:
  static constexpr std::size_t most_entries = 256;
  std::array<std::int64_t, most_entries> values_{};
  std::array<std::uint8_t, longest_text> label_{};
  std::size_t label_length_ = 0;
};

}  // namespace feedtwin::io::can
