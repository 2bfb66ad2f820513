#pragma once
// The drive's objects as one table: the code, the EDS (eds.h) and the DBC (dbc.h) all come from it. CiA 301 and CiA 402.

#include <cstdint>
#include <span>
#include <string_view>

#include "plant/realtime.h"

namespace feedtwin::io::can {

/// CiA 301, data type codes.
enum class DataType : std::uint8_t { i8 = 2, i16 = 3, i32 = 4, u8 = 5, u16 = 6, u32 = 7, text = 9 };
enum class Access : std::uint8_t { read, read_write, constant };
/// What a PDO may carry: nothing, into the drive, out of the drive.
enum class Mappable : std::uint8_t { no, receive, transmit };
enum class ObjectKind : std::uint8_t { variable = 7, array = 8, record = 9 };
/// Where a default value gets its offset from.
enum class Preset : std::uint8_t { fixed, plus_node_id, of_axis };

struct ObjectEntry {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::string_view name;  ///< CiA 306: the parameter name
  DataType type = DataType::u32;
  Access access = Access::read;
  Mappable mappable = Mappable::no;
  std::int64_t preset = 0;
  std::int64_t lowest = 0, highest = 0;
  Preset preset_kind = Preset::fixed;
  std::string_view text = {};  ///< a text's value
  std::string_view unit = {};
};

/// An object of several sub-indices.
struct ObjectGroup {
  std::uint16_t index = 0;
  ObjectKind kind = ObjectKind::record;
  std::string_view name;
};

/// All entries in the order of index and sub-index.
[[nodiscard]] std::span<const ObjectEntry> object_table() noexcept FEEDTWIN_REALTIME;
[[nodiscard]] std::span<const ObjectGroup> object_groups() noexcept;

inline constexpr int no_entry = -1;
/// Position in object_table(), or no_entry. Bounded: a binary search.
[[nodiscard]] int entry_of(std::uint16_t index, std::uint8_t sub) noexcept FEEDTWIN_REALTIME;
/// True if any sub-index of the object exists.
[[nodiscard]] bool object_exists(std::uint16_t index) noexcept FEEDTWIN_REALTIME;

/// Bytes of a number; 0 for a text.
[[nodiscard]] constexpr int bytes_of(DataType type) noexcept FEEDTWIN_REALTIME {
  switch (type) {
    case DataType::i8:
    case DataType::u8:
      return 1;
    case DataType::i16:
    case DataType::u16:
      return 2;
    case DataType::i32:
    case DataType::u32:
      return 4;
    case DataType::text:
      return 0;
  }
  return 0;
}
[[nodiscard]] constexpr bool is_signed(DataType type) noexcept FEEDTWIN_REALTIME {
  return type == DataType::i8 || type == DataType::i16 || type == DataType::i32;
}

inline constexpr int pdos = 4;            ///< of each direction
inline constexpr int mapped_objects = 8;  ///< at most, in one PDO
inline constexpr int error_history = 8;   ///< entries of 1003
inline constexpr std::size_t longest_text = 32;

}  // namespace feedtwin::io::can
