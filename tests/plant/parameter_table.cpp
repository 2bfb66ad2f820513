#include "plant/parameter_table.h"

#include <gtest/gtest.h>

#include <set>

namespace feedtwin::plant {
namespace {

TEST(ParameterTable, EveryKeyHasANumberOfItsOwn) {
  AxisParameters p;
  std::set<const double*> places;
  std::set<std::string_view> keys;
  for (const auto& entry : parameter_table()) {
    EXPECT_TRUE(places.insert(&entry.in(p)).second) << entry.key << " shares its number with another key";
    EXPECT_TRUE(keys.insert(entry.key).second) << entry.key << " stands twice";
    EXPECT_EQ(find_parameter(entry.key), &entry);
    EXPECT_FALSE(entry.meaning.empty()) << entry.key;
  }
  EXPECT_EQ(find_parameter("motor.nothing"), nullptr);
}

TEST(ParameterTable, EveryNumberOfAnAxisHasAKey) {
  EXPECT_EQ(parameter_table().size() * sizeof(double) + sizeof(AxisParameters::effects), sizeof(AxisParameters))
      << "a number without a key, or a key too many";
}

TEST(ParameterTable, PresetsAndTheSourceLieWithinTheRanges) {
  AxisParameters source = source_axis();
  for (const auto& entry : parameter_table()) {
    EXPECT_LT(entry.lowest, entry.highest) << entry.key;
    const double preset = entry.preset.value_or(entry.lowest);
    EXPECT_TRUE(preset >= entry.lowest && preset <= entry.highest) << entry.key;
    const double value = entry.in(source);
    EXPECT_TRUE(value >= entry.lowest && value <= entry.highest) << entry.key << " = " << value;
  }
}

TEST(ParameterTable, KeysEndInTheirUnit) {
  for (const auto& entry : parameter_table()) {
    const auto unit = entry.key.substr(entry.key.rfind('.') + 1);
    EXPECT_TRUE(unit.find('_') != std::string_view::npos) << entry.key;
  }
}

}  // namespace
}  // namespace feedtwin::plant
