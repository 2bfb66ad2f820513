#include "controllers/gcode/word_rules.h"

#include <string>

namespace feedtwin::controllers::gcode {

void check_words(const Block& block, const Codes& codes, int motion_in_force) {
  const auto& written = codes[GGroup::motion];
  const int motion = written ? written->tenths / 10 : motion_in_force;
  const bool homing = is(codes[GGroup::non_modal], 280);
  const bool moves = (written || has_axis(block)) && motion != no_motion && !homing;
  const bool arc = moves && (motion == 2 || motion == 3);
  const bool dwell = is(codes[GGroup::non_modal], 40);
  const bool blending = is(codes[GGroup::path_mode], 640);
  const auto needs = [&](char letter, bool allowed, const char* where) {
    const auto& word = block.word(letter);
    if (word && !allowed) {
      block.fail(word->at, std::string("a ") + static_cast<char>(letter - 'a' + 'A') + " word without " + where);
    }
  };
  for (const char letter : {'i', 'j', 'k', 'r'}) needs(letter, arc, "G2 or G3");
  needs('p', arc || dwell || blending, "G2, G3, G4 or G64");
  needs('q', blending, "G64");
  if (homing && written) block.fail(written->at, "a motion on the same line as G28");
  if (homing && !codes.machine_coordinates) return;
  if (codes.machine_coordinates && !(moves && motion <= 1)) {
    block.fail(codes[GGroup::non_modal]->at, "G53 without G0 or G1");
  }
  if (!has_axis(block)) return;
  const auto& axis = block.word('x') ? block.word('x') : block.word('y') ? block.word('y') : block.word('z');
  if (!moves) block.fail(axis->at, "an axis word without a motion in force");
}

}  // namespace feedtwin::controllers::gcode
