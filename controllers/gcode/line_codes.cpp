#include "controllers/gcode/line_codes.h"

namespace feedtwin::controllers::gcode {

std::string shown(char letter, int tenths) {
  std::string text = letter + std::to_string(tenths / 10);
  return tenths % 10 == 0 ? text : text + "." + std::to_string(tenths % 10);
}

Codes sort_codes(const Block& block) {
  Codes codes;
  for (const Code& code : block.g) {
    const auto group = group_of_g(code.tenths);
    if (!group) block.fail(code.at, shown('G', code.tenths) + " is not supported");
    auto& slot = codes.g[static_cast<std::size_t>(*group)];
    if (slot) block.fail(code.at, shown('G', code.tenths) + " excludes " + shown('G', slot->tenths) + " on the same line");
    slot = code;
    codes.machine_coordinates = codes.machine_coordinates || code.tenths == 530;
  }
  for (const Code& code : block.m) {
    const auto group = group_of_m(code.tenths);
    if (!group) block.fail(code.at, shown('M', code.tenths) + " is not supported");
    auto& slot = codes.m[static_cast<std::size_t>(*group)];
    const bool both_pumps = slot && (slot->tenths == 70 || slot->tenths == 80) && (code.tenths == 70 || code.tenths == 80) &&
                            slot->tenths != code.tenths;
    if (slot && !both_pumps) {
      block.fail(code.at, shown('M', code.tenths) + " excludes " + shown('M', slot->tenths) + " on the same line");
    }
    slot = code;
    codes.mist = codes.mist || code.tenths == 70;
    codes.flood = codes.flood || code.tenths == 80;
  }
  return codes;
}

}  // namespace feedtwin::controllers::gcode
