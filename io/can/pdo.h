#pragma once
// Process data objects: which objects a frame carries, and packing them. CiA 301.

#include <array>
#include <cstdint>

#include "io/can/frame.h"
#include "io/can/object_values.h"

namespace feedtwin::io::can {

/// What one PDO carries, resolved against the table.
struct PdoMapping {
  struct Part {
    int entry = no_entry;  ///< no_entry: a gap (dummy objects 0002..0007)
    std::uint8_t bytes = 0;
  };
  std::array<Part, mapped_objects> parts{};
  int count = 0;
  int bytes = 0;

  [[nodiscard]] bool carries(int entry) const noexcept FEEDTWIN_REALTIME;
};

/// Resolve one mapping word (index, sub-index, bits). Abort::ok, not_mappable or no_object.
[[nodiscard]] Abort resolve(std::uint32_t word, Mappable direction, PdoMapping::Part& part) noexcept FEEDTWIN_REALTIME;
/// Resolve `count` words; pdo_too_long above 8 bytes.
[[nodiscard]] Abort resolve(const ObjectValues& objects, int first_entry, int count, Mappable direction,
                            PdoMapping& mapping) noexcept FEEDTWIN_REALTIME;

void pack(const PdoMapping& mapping, const ObjectValues& objects, Frame& frame) noexcept FEEDTWIN_REALTIME;

/// Calls take(entry, value) for each object in the frame; the frame has at least mapping.bytes.
template <class Take>
void unpack(const PdoMapping& mapping, const Frame& frame, Take take) noexcept FEEDTWIN_REALTIME {
  std::size_t at = 0;
  for (int i = 0; i < mapping.count; ++i) {
    const auto& part = mapping.parts[static_cast<std::size_t>(i)];
    if (part.entry != no_entry) {
      const auto type = object_table()[static_cast<std::size_t>(part.entry)].type;
      take(part.entry, ObjectValues::decode(type, {frame.data.data() + at, part.bytes}));
    }
    at += part.bytes;
  }
}

}  // namespace feedtwin::io::can
