#include "io/can/object_dictionary.h"

#include <algorithm>
#include <array>
#include <limits>

namespace feedtwin::io::can {
namespace {

using enum DataType;
using enum Access;

constexpr std::uint32_t off = 0x8000'0000U;        // COB-ID: this PDO does not exist
constexpr std::uint32_t no_remote = 0x4000'0000U;  // COB-ID: not to be asked for by remote frames

/// An entry whose limits are those of its type.
constexpr ObjectEntry plain(int index, int sub, std::string_view name, DataType type, Access access, std::int64_t preset = 0,
                            Mappable mappable = Mappable::no, std::string_view unit = {}) {
  const int bits = 8 * bytes_of(type);
  const std::int64_t span = bits == 0 ? 0 : std::int64_t{1} << (is_signed(type) ? bits - 1 : bits);
  return {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub), name,          type, access, mappable, preset,
          is_signed(type) ? -span : 0,       span == 0 ? 0 : span - 1,       Preset::fixed, {},   unit};
}
constexpr ObjectEntry limited(ObjectEntry entry, std::int64_t lowest, std::int64_t highest) {
  entry.lowest = lowest;
  entry.highest = highest;
  return entry;
}
constexpr ObjectEntry with_node_id(ObjectEntry entry) {
  entry.preset_kind = Preset::plus_node_id;
  return entry;
}
constexpr ObjectEntry of_axis(ObjectEntry entry) {
  entry.preset_kind = Preset::of_axis;
  return entry;
}
constexpr ObjectEntry worded(int index, std::string_view name, Access access, std::string_view value) {
  auto entry = plain(index, 0, name, text, access);
  entry.text = value;
  return entry;
}
/// Sub-index 0 of an array or record: the highest sub-index.
constexpr ObjectEntry highest_sub(int index, int highest) {
  return limited(plain(index, 0, "Highest sub-index supported", u8, constant, highest), highest, highest);
}

constexpr std::uint32_t mapped(std::uint32_t index_and_sub, std::uint32_t bits) {
  return index_and_sub << 8 | bits;
}

struct Table {
  std::array<ObjectEntry, 256> entries{};  // NOLINT(bugprone-invalid-enum-default-initialization): beyond size, never read
  std::size_t size = 0;
  constexpr void add(const ObjectEntry& entry) { entries[size++] = entry; }

  constexpr void communication(int index, std::int64_t cob_id, int type, bool transmit) {
    add(highest_sub(index, transmit ? 5 : 2));
    add(with_node_id(plain(index, 1, transmit ? "COB-ID used by TPDO" : "COB-ID used by RPDO", u32, read_write, cob_id)));
    add(plain(index, 2, "Transmission type", u8, read_write, type));
    if (transmit) add(plain(index, 5, "Event timer", u16, read_write, 0, Mappable::no, "ms"));
  }
  constexpr void mapping(int index, const std::array<std::uint32_t, mapped_objects>& objects) {
    constexpr std::array<std::string_view, mapped_objects> names = {"Mapped object 1", "Mapped object 2", "Mapped object 3",
                                                                    "Mapped object 4", "Mapped object 5", "Mapped object 6",
                                                                    "Mapped object 7", "Mapped object 8"};
    int used = 0;
    for (const auto object : objects) used += object != 0 ? 1 : 0;
    add(limited(plain(index, 0, "Number of mapped objects", u8, read_write, used), 0, mapped_objects));
    for (int i = 0; i < mapped_objects; ++i) {
      const auto n = static_cast<std::size_t>(i);
      add(plain(index, i + 1, names[n], u32, read_write, objects[n]));
    }
  }
};

constexpr void add_communication_profile(Table& t) {
  t.add(plain(0x1000, 0, "Device type", u32, constant, 0x0002'0192));
  t.add(plain(0x1001, 0, "Error register", u8, read, 0, Mappable::transmit));
  t.add(limited(plain(0x1003, 0, "Number of errors", u8, read_write, 0), 0, 0));
  constexpr std::array<std::string_view, error_history> errors = {
      "Standard error field 1", "Standard error field 2", "Standard error field 3", "Standard error field 4",
      "Standard error field 5", "Standard error field 6", "Standard error field 7", "Standard error field 8"};
  for (int i = 0; i < error_history; ++i) t.add(plain(0x1003, i + 1, errors[static_cast<std::size_t>(i)], u32, read));
  t.add(plain(0x1005, 0, "COB-ID SYNC message", u32, read, 0x80));
  t.add(plain(0x1006, 0, "Communication cycle period", u32, read_write, 0, Mappable::no, "us"));
  t.add(worded(0x1008, "Manufacturer device name", constant, "feedtwin drive"));
  t.add(worded(0x1009, "Manufacturer hardware version", constant, "simulated"));
  t.add(worded(0x100A, "Manufacturer software version", constant, "0.1.0"));
  t.add(with_node_id(plain(0x1014, 0, "COB-ID EMCY", u32, read, 0x80)));
  t.add(highest_sub(0x1016, 1));
  t.add(plain(0x1016, 1, "Consumer heartbeat time", u32, read_write));
  t.add(plain(0x1017, 0, "Producer heartbeat time", u16, read_write, 0, Mappable::no, "ms"));
  t.add(highest_sub(0x1018, 4));
  t.add(plain(0x1018, 1, "Vendor-ID", u32, constant, 0));
  t.add(plain(0x1018, 2, "Product code", u32, constant, 402));
  t.add(plain(0x1018, 3, "Revision number", u32, constant, 0x0000'0001));
  t.add(plain(0x1018, 4, "Serial number", u32, constant, 0));
  t.add(highest_sub(0x1200, 2));
  t.add(with_node_id(plain(0x1200, 1, "COB-ID client to server", u32, read, 0x600)));
  t.add(with_node_id(plain(0x1200, 2, "COB-ID server to client", u32, read, 0x580)));
}

constexpr void add_pdos(Table& t) {
  for (int i = 0; i < pdos; ++i)
    t.communication(0x1400 + i, (i == 0 ? 0U : off) + 0x200U + 0x100U * static_cast<unsigned>(i), 1, false);
  t.mapping(0x1600, {mapped(0x6040'00, 16), mapped(0x6071'00, 16), mapped(0x6060'00, 8)});
  for (int i = 1; i < pdos; ++i) t.mapping(0x1600 + i, {});
  for (int i = 0; i < pdos; ++i) {
    t.communication(0x1800 + i, (i < 2 ? no_remote : no_remote | off) + 0x180U + 0x100U * static_cast<unsigned>(i),
                    i == 1 ? 10 : 1, true);
  }
  t.mapping(0x1A00, {mapped(0x6041'00, 16), mapped(0x6064'00, 32), mapped(0x6077'00, 16)});
  t.mapping(0x1A01, {mapped(0x606C'00, 32), mapped(0x6061'00, 8), mapped(0x603F'00, 16)});
  for (int i = 2; i < pdos; ++i) t.mapping(0x1A00 + i, {});
}

constexpr void add_manufacturer_objects(Table& t) {
  t.add(worded(0x2000, "Axis label", read_write, "axis"));
  t.add(limited(plain(0x2001, 0, "SYNCs without RPDO before the reaction of 6007", u8, read_write, 3), 0, 255));
  t.add(plain(0x2002, 0, "SYNC timeout while enabled, 0 for none", u16, read_write, 100, Mappable::no, "ms"));
  t.add(of_axis(plain(0x2003, 0, "Ball screw lead", u32, constant, 0, Mappable::no, "nm")));
  t.add(plain(0x2004, 0, "Ticks of the plant behind the position", u32, read, 0, Mappable::transmit));
  // of the machine tool that the first axis belongs to
  t.add(plain(0x2010, 0, "Spindle speed", u16, read_write, 0, Mappable::receive, "rpm"));
  t.add(limited(plain(0x2011, 0, "Auxiliary functions", u8, read_write, 0, Mappable::receive), 0, 15));
  t.add(plain(0x2012, 0, "Depth of cut of a slot", u16, read_write, 0, Mappable::receive, "um"));
}

constexpr void add_drive_profile(Table& t) {
  using enum Mappable;
  t.add(limited(plain(0x6007, 0, "Abort connection option code", i16, read_write, 1), 0, 3));
  t.add(plain(0x603F, 0, "Error code", u16, read, 0, transmit));
  t.add(plain(0x6040, 0, "Controlword", u16, read_write, 0, receive));
  t.add(plain(0x6041, 0, "Statusword", u16, read, 0, transmit));
  t.add(limited(plain(0x605A, 0, "Quick stop option code", i16, read_write, 2), 0, 7));
  t.add(limited(plain(0x605E, 0, "Fault reaction option code", i16, read_write, 0), 0, 2));
  t.add(limited(plain(0x6060, 0, "Modes of operation", i8, read_write, 10, receive), 0, 10));
  t.add(plain(0x6061, 0, "Modes of operation display", i8, read, 10, transmit));
  t.add(plain(0x6064, 0, "Position actual value", i32, read, 0, transmit, "counts"));
  t.add(plain(0x606C, 0, "Velocity actual value", i32, read, 0, transmit, "counts/s"));
  t.add(plain(0x6071, 0, "Target torque", i16, read_write, 0, receive, "1/1000 of rated torque"));
  t.add(limited(plain(0x6072, 0, "Max torque", u16, read_write, 3000, receive, "1/1000 of rated torque"), 0, 32767));
  t.add(plain(0x6074, 0, "Torque demand", i16, read, 0, transmit, "1/1000 of rated torque"));
  t.add(of_axis(plain(0x6076, 0, "Motor rated torque", u32, constant, 0, no, "mNm")));
  t.add(plain(0x6077, 0, "Torque actual value", i16, read, 0, transmit, "1/1000 of rated torque"));
  t.add(of_axis(plain(0x6085, 0, "Quick stop deceleration", u32, read_write, 0, no, "counts/s^2")));
  t.add(highest_sub(0x608F, 2));
  t.add(of_axis(plain(0x608F, 1, "Encoder increments", u32, constant, 0, no, "counts")));
  t.add(plain(0x608F, 2, "Motor revolutions", u32, constant, 1));
  t.add(highest_sub(0x6091, 2));
  t.add(plain(0x6091, 1, "Motor revolutions", u32, constant, 1));
  t.add(plain(0x6091, 2, "Shaft revolutions", u32, constant, 1));
  t.add(highest_sub(0x6092, 2));
  t.add(of_axis(plain(0x6092, 1, "Feed", u32, constant, 0, no, "counts")));
  t.add(plain(0x6092, 2, "Shaft revolutions", u32, constant, 1));
  t.add(plain(0x60B2, 0, "Torque offset", i16, read_write, 0, receive, "1/1000 of rated torque"));
  t.add(highest_sub(0x60C2, 2));
  t.add(limited(plain(0x60C2, 1, "Interpolation time period value", u8, read_write, 1), 1, 255));
  t.add(limited(plain(0x60C2, 2, "Interpolation time index", i8, read_write, -3), -6, 0));
  t.add(plain(0x60FD, 0, "Digital inputs", u32, read, 0, transmit));
  t.add(plain(0x6502, 0, "Supported drive modes", u32, constant, 1U << 9));
}

constexpr Table make_table() {
  Table table;
  add_communication_profile(table);
  add_pdos(table);
  add_manufacturer_objects(table);
  add_drive_profile(table);
  return table;
}

constexpr Table table = make_table();

constexpr std::uint32_t key(const ObjectEntry& entry) {
  return static_cast<std::uint32_t>(entry.index) << 8 | entry.sub;
}
constexpr bool in_order() {
  for (std::size_t i = 1; i < table.size; ++i) {
    if (key(table.entries[i]) <= key(table.entries[i - 1])) return false;
  }
  return true;
}
static_assert(in_order());

constexpr std::array groups{
    ObjectGroup{0x1003, ObjectKind::array, "Pre-defined error field"},
    ObjectGroup{0x1016, ObjectKind::array, "Consumer heartbeat time"},
    ObjectGroup{0x1018, ObjectKind::record, "Identity object"},
    ObjectGroup{0x1200, ObjectKind::record, "SDO server parameter"},
    ObjectGroup{0x1400, ObjectKind::record, "RPDO 1 communication parameter"},
    ObjectGroup{0x1401, ObjectKind::record, "RPDO 2 communication parameter"},
    ObjectGroup{0x1402, ObjectKind::record, "RPDO 3 communication parameter"},
    ObjectGroup{0x1403, ObjectKind::record, "RPDO 4 communication parameter"},
    ObjectGroup{0x1600, ObjectKind::record, "RPDO 1 mapping parameter"},
    ObjectGroup{0x1601, ObjectKind::record, "RPDO 2 mapping parameter"},
    ObjectGroup{0x1602, ObjectKind::record, "RPDO 3 mapping parameter"},
    ObjectGroup{0x1603, ObjectKind::record, "RPDO 4 mapping parameter"},
    ObjectGroup{0x1800, ObjectKind::record, "TPDO 1 communication parameter"},
    ObjectGroup{0x1801, ObjectKind::record, "TPDO 2 communication parameter"},
    ObjectGroup{0x1802, ObjectKind::record, "TPDO 3 communication parameter"},
    ObjectGroup{0x1803, ObjectKind::record, "TPDO 4 communication parameter"},
    ObjectGroup{0x1A00, ObjectKind::record, "TPDO 1 mapping parameter"},
    ObjectGroup{0x1A01, ObjectKind::record, "TPDO 2 mapping parameter"},
    ObjectGroup{0x1A02, ObjectKind::record, "TPDO 3 mapping parameter"},
    ObjectGroup{0x1A03, ObjectKind::record, "TPDO 4 mapping parameter"},
    ObjectGroup{0x608F, ObjectKind::array, "Position encoder resolution"},
    ObjectGroup{0x6091, ObjectKind::array, "Gear ratio"},
    ObjectGroup{0x6092, ObjectKind::array, "Feed constant"},
    ObjectGroup{0x60C2, ObjectKind::record, "Interpolation time period"},
};

}  // namespace

std::span<const ObjectEntry> object_table() noexcept FEEDTWIN_REALTIME {
  return {table.entries.data(), table.size};
}

std::span<const ObjectGroup> object_groups() noexcept {
  return groups;
}

int entry_of(std::uint16_t index, std::uint8_t sub) noexcept FEEDTWIN_REALTIME {
  const std::uint32_t wanted = static_cast<std::uint32_t>(index) << 8 | sub;
  std::size_t low = 0, high = table.size;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (key(table.entries[middle]) < wanted) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < table.size && key(table.entries[low]) == wanted ? static_cast<int>(low) : no_entry;
}

bool object_exists(std::uint16_t index) noexcept FEEDTWIN_REALTIME {
  return entry_of(index, 0) != no_entry;  // every object has sub-index 0
}

}  // namespace feedtwin::io::can
