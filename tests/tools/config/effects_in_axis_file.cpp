// Effects in axis files: written and read back, and refused with the line and the key.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <random>
#include <string>

#include "plant/effects/registry.h"
#include "plant/parameter_table.h"
#include "tests/support/any_effect.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

TEST(EffectsInAxisFile, SurviveWritingAndReading) {
  const auto path = std::filesystem::temp_directory_path() / ("feedtwin_effects_" + std::to_string(::getpid()) + ".toml");
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    plant::AxisParameters axis = plant::source_axis();
    for (const auto& entry : plant::effect_registry()) {
      const int copies = 1 + static_cast<int>(random() % 2);
      for (int i = 0; i < copies; ++i) axis.effects.push_back(test::any_setting(entry, random));
    }
    write_axis_file(path.string(), axis);
    auto read = read_axis_file(path.string()).effects;
    std::ranges::stable_sort(axis.effects, {}, &plant::EffectSetting::id);  // a file keeps no order between ids
    std::ranges::stable_sort(read, {}, &plant::EffectSetting::id);
    EXPECT_EQ(read, axis.effects) << "seed " << seed;
  }
  std::filesystem::remove(path);
}

/// What the reader says of the source's axis with this text behind it.
std::string complaint(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("feedtwin_effect_" + std::to_string(::getpid()) + ".toml");
  write_axis_file(path.string(), plant::source_axis());
  const std::string head = read_whole_file(path.string());
  const auto lines = std::ranges::count(head, '\n');
  write_whole_file(path.string(), head + text);
  std::string said;
  try {
    (void)read_axis_file(path.string());
  } catch (const InputError& error) {
    said = error.what();
  }
  std::filesystem::remove(path);
  // the line within the text
  const auto colon = said.find(".toml:");
  if (colon == std::string::npos || std::isdigit(static_cast<unsigned char>(said[colon + 6])) == 0) return said;
  const auto end = said.find(':', colon + 6);
  return std::to_string(std::stol(said.substr(colon + 6, end - colon - 6)) - lines) + said.substr(end);
}

TEST(EffectsInAxisFile, AreRefusedWithLineAndKey) {
  EXPECT_EQ(complaint("[effects.cogging]\namplitude_Nm = 0.02\ncycles_per_rev = 12\n"), "");
  EXPECT_EQ(complaint("[effects.backlash]\ngap_m = 1e-6\n[effects.warp]\nfactor = 9\n"), "3: effects.warp: unknown effect");
  EXPECT_EQ(complaint("[effects.cogging]\namplitude_Nm = 0.02\ncycles_per_rev = 12\nphase = 1\n"),
            "4: effects.cogging.phase: cogging has no such parameter");
  EXPECT_NE(
      complaint("[effects.cogging]\namplitude_Nm = -0.02\ncycles_per_rev = 12\n").find("2: effects.cogging.amplitude_Nm"),
      std::string::npos);
  EXPECT_NE(complaint("[[effects.cogging]]\namplitude_Nm = 0.02\ncycles_per_rev = 12\n"
                      "[[effects.cogging]]\namplitude_Nm = \"big\"\ncycles_per_rev = 12\n")
                .find("5: effects.cogging[1].amplitude_Nm"),
            std::string::npos);
  EXPECT_NE(complaint("[effects.cogging]\namplitude_Nm = 0.02\n").find("effects.cogging.cycles_per_rev: missing"),
            std::string::npos);
  EXPECT_NE(complaint("[effects.learned_residual]\nposition_m = [0.0, 0.1]\nforce_pos_N = [1.0]\n")
                .find("effects.learned_residual: force_pos_N must have one number for each point"),
            std::string::npos);
  EXPECT_NE(complaint("[effects]\ncogging = 3\n"), "");
}

}  // namespace
}  // namespace feedtwin::tools
