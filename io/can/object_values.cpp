#include "io/can/object_values.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace feedtwin::io::can {

/// What a feed drive's power supply lets it do without a thought: one g.
constexpr double quick_stop_m_per_s2 = 9.81;

std::int64_t preset_of(const ObjectEntry& entry, const DriveIdentity& drive) noexcept FEEDTWIN_REALTIME {
  if (entry.preset_kind == Preset::plus_node_id) return entry.preset + drive.node_id;
  if (entry.preset_kind == Preset::fixed) return entry.preset;
  switch (entry.index) {
    case 0x2003:
      return std::llround(drive.lead_m * 1e9);
    case 0x6085:
      return std::llround(std::min(quick_stop_m_per_s2 * drive.encoder_counts_per_rev / drive.lead_m, 4294967295.0));
    case 0x6076:
      return std::llround(drive.rated_torque_Nm * 1e3);
    default:  // 608F and 6092: one motor revolution in counts
      return std::llround(drive.encoder_counts_per_rev);
  }
}

void ObjectValues::reset(const DriveIdentity& drive, std::uint16_t first, std::uint16_t last) noexcept FEEDTWIN_REALTIME {
  const auto table = object_table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].index < first || table[i].index > last) continue;
    values_[i] = preset_of(table[i], drive);
    if (table[i].type == DataType::text && table[i].access == Access::read_write) {
      set_label({reinterpret_cast<const std::uint8_t*>(table[i].text.data()), table[i].text.size()});
    }
  }
}

std::size_t ObjectValues::encode(int entry, std::span<std::uint8_t> bytes) const noexcept FEEDTWIN_REALTIME {
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  if (object.type == DataType::text) {
    if (object.access == Access::read_write) {
      std::memcpy(bytes.data(), label_.data(), label_length_);
      return label_length_;
    }
    const std::size_t length = std::min(object.text.size(), bytes.size());
    std::memcpy(bytes.data(), object.text.data(), length);
    return length;
  }
  const auto length = static_cast<std::size_t>(bytes_of(object.type));
  const auto value = static_cast<std::uint64_t>(get(entry));
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  return length;
}

std::int64_t ObjectValues::decode(DataType type, std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  const auto bits = 8 * static_cast<unsigned>(bytes.size());
  if (is_signed(type) && (value >> (bits - 1) & 1U) != 0) value |= ~std::uint64_t{0} << bits;
  return static_cast<std::int64_t>(value);
}

Abort ObjectValues::check(const ObjectEntry& entry, std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME {
  if (entry.access != Access::read_write) return Abort::read_only;
  const auto length = entry.type == DataType::text ? longest_text : static_cast<std::size_t>(bytes_of(entry.type));
  if (bytes.size() > length) return Abort::too_long;
  if (entry.type == DataType::text) return Abort::ok;
  if (bytes.size() < length) return Abort::too_short;
  const auto value = decode(entry.type, bytes);
  if (value > entry.highest) return Abort::too_high;
  return value < entry.lowest ? Abort::too_low : Abort::ok;
}

void ObjectValues::set_label(std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME {
  label_length_ = std::min(bytes.size(), longest_text);
  std::memcpy(label_.data(), bytes.data(), label_length_);
}

}  // namespace feedtwin::io::can
