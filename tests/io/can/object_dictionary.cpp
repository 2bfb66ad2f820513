#include "io/can/object_dictionary.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "io/can/object_values.h"
#include "io/can/pdo.h"

namespace feedtwin::io::can {
namespace {

TEST(ObjectDictionary, HoldsWhatTheProfilesAskFor) {
  // CiA 301 and CiA 402 for a drive in cyclic synchronous torque mode
  for (const int index :
       {0x1000, 0x1001, 0x1003, 0x1005, 0x1006, 0x1008, 0x1009, 0x100A, 0x1014, 0x1016, 0x1017, 0x1018, 0x1400,
        0x1600, 0x1800, 0x1A00, 0x603F, 0x6040, 0x6041, 0x605A, 0x605E, 0x6007, 0x6060, 0x6061, 0x6502, 0x6064,
        0x606C, 0x6071, 0x6077, 0x6076, 0x6072, 0x608F, 0x6091, 0x6092, 0x60B2, 0x60C2, 0x60FD}) {
    EXPECT_TRUE(object_exists(static_cast<std::uint16_t>(index))) << std::hex << index;
  }
}

TEST(ObjectDictionary, EveryDefaultIsWithinItsLimitsAndType) {
  for (const auto& entry : object_table()) {
    if (entry.type == DataType::text) continue;
    const auto value = preset_of(entry, DriveIdentity{.node_id = 127});
    EXPECT_GE(value, entry.lowest) << entry.name;
    EXPECT_LE(value, entry.highest) << entry.name;
    EXPECT_LE(entry.highest - entry.lowest, std::int64_t{1} << (8 * bytes_of(entry.type))) << entry.name;
  }
}

TEST(ObjectDictionary, GroupsAreExactlyTheObjectsWithSeveralEntries) {
  std::map<int, int> entries;
  for (const auto& entry : object_table()) ++entries[entry.index];
  std::set<int> grouped, several;
  for (const auto& group : object_groups()) grouped.insert(group.index);
  for (const auto& [index, count] : entries) {
    if (count > 1) several.insert(index);
  }
  EXPECT_EQ(grouped, several);
}

TEST(ObjectDictionary, EntriesAreFoundAndOnlyThose) {
  const auto table = object_table();
  std::set<std::pair<int, int>> known;
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(entry_of(table[i].index, table[i].sub), static_cast<int>(i));
    known.emplace(table[i].index, table[i].sub);
  }
  for (int index = 0; index < 0x10000; ++index) {
    for (const int sub : {0, 1, 2, 5, 9, 255}) {
      if (known.contains({index, sub})) continue;
      ASSERT_EQ(entry_of(static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)), no_entry)
          << index << ":" << sub;
    }
  }
}

TEST(ObjectValues, NumbersSurviveTheWire) {
  ObjectValues values(DriveIdentity{});
  for (int i = 0; i < static_cast<int>(object_table().size()); ++i) {
    const auto& entry = object_table()[static_cast<std::size_t>(i)];
    if (entry.type == DataType::text) continue;
    for (const auto value : {entry.lowest, entry.highest, entry.preset}) {
      values.set(i, value);
      std::array<std::uint8_t, longest_text> bytes{};
      const auto n = values.encode(i, bytes);
      EXPECT_EQ(ObjectValues::decode(entry.type, std::span(bytes).first(n)), value) << entry.name;
    }
  }
}

TEST(ObjectValues, DefaultPdosHaveTheirStatedLengths) {
  const ObjectValues values(DriveIdentity{});
  const auto bytes = [&](int index, Mappable direction) {
    const int entry = entry_of(static_cast<std::uint16_t>(index), 0);
    PdoMapping mapping;
    EXPECT_EQ(resolve(values, entry + 1, static_cast<int>(values.get(entry)), direction, mapping), Abort::ok);
    return mapping.bytes;
  };
  EXPECT_EQ(bytes(0x1600, Mappable::receive), 5);
  EXPECT_EQ(bytes(0x1A00, Mappable::transmit), 8);
  EXPECT_EQ(bytes(0x1A01, Mappable::transmit), 7);
}

}  // namespace
}  // namespace feedtwin::io::can
