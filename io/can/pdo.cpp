#include "io/can/pdo.h"

namespace feedtwin::io::can {

bool PdoMapping::carries(int entry) const noexcept FEEDTWIN_REALTIME {
  for (int i = 0; i < count; ++i) {
    if (parts[static_cast<std::size_t>(i)].entry == entry) return true;
  }
  return false;
}

Abort resolve(std::uint32_t word, Mappable direction, PdoMapping::Part& part) noexcept FEEDTWIN_REALTIME {
  const auto index = static_cast<std::uint16_t>(word >> 16);
  const auto sub = static_cast<std::uint8_t>(word >> 8);
  const std::uint32_t bits = word & 0xFFU;
  if (index >= 2 && index <= 7 && direction == Mappable::receive) {  // a gap as wide as its data type
    const auto bytes = static_cast<std::uint8_t>(bytes_of(static_cast<DataType>(index)));
    part = {no_entry, bytes};
    return sub == 0 && bits == 8U * bytes ? Abort::ok : Abort::not_mappable;
  }
  const int entry = entry_of(index, sub);
  if (entry == no_entry) return object_exists(index) ? Abort::no_sub : Abort::no_object;
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  const auto bytes = static_cast<std::uint8_t>(bytes_of(object.type));
  if (object.mappable != direction || bits != 8U * bytes) return Abort::not_mappable;
  part = {entry, bytes};
  return Abort::ok;
}

Abort resolve(const ObjectValues& objects, int first_entry, int count, Mappable direction,
              PdoMapping& mapping) noexcept FEEDTWIN_REALTIME {
  PdoMapping made;
  for (int i = 0; i < count; ++i) {
    auto& part = made.parts[static_cast<std::size_t>(i)];
    const auto result = resolve(static_cast<std::uint32_t>(objects.get(first_entry + i)), direction, part);
    if (result != Abort::ok) return result;
    made.bytes += part.bytes;
    ++made.count;
    if (made.bytes > 8) return Abort::pdo_too_long;
  }
  mapping = made;
  return Abort::ok;
}

void pack(const PdoMapping& mapping, const ObjectValues& objects, Frame& frame) noexcept FEEDTWIN_REALTIME {
  std::array<std::uint8_t, longest_text> bytes{};
  std::size_t at = 0;
  for (int i = 0; i < mapping.count; ++i) {
    const auto& part = mapping.parts[static_cast<std::size_t>(i)];
    (void)objects.encode(part.entry, bytes);
    for (std::size_t k = 0; k < part.bytes; ++k) frame.data[at++] = bytes[k];
  }
  frame.length = static_cast<std::uint8_t>(mapping.bytes);
}

}  // namespace feedtwin::io::can
