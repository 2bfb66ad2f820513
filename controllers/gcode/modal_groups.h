#pragma once
// Which codes exclude each other on a line (NISTIR 6556, table 4).

#include <optional>

namespace feedtwin::controllers::gcode {

enum class GGroup { non_modal, motion, plane, distance, feed_mode, units, cutter_radius, coordinates, path_mode, count };
enum class MGroup { stopping, tool_change, spindle, coolant, count };

/// The group of a G code (times ten), or nothing for a code that is not supported.
[[nodiscard]] constexpr std::optional<GGroup> group_of_g(int tenths) noexcept {
  switch (tenths) {
    case 40:
    case 280:
    case 530:
      return GGroup::non_modal;
    case 0:
    case 10:
    case 20:
    case 30:
    case 800:
      return GGroup::motion;
    case 170:
    case 180:
    case 190:
      return GGroup::plane;
    case 900:
    case 910:
      return GGroup::distance;
    case 930:
    case 940:
    case 950:
      return GGroup::feed_mode;
    case 200:
    case 210:
      return GGroup::units;
    case 400:
      return GGroup::cutter_radius;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
    case 591:
    case 592:
    case 593:
      return GGroup::coordinates;
    case 610:
    case 611:
    case 640:
      return GGroup::path_mode;
    default:
      return std::nullopt;
  }
}

/// The same for M codes.
[[nodiscard]] constexpr std::optional<MGroup> group_of_m(int tenths) noexcept {
  switch (tenths) {
    case 0:
    case 10:
    case 20:
    case 300:
      return MGroup::stopping;
    case 60:
      return MGroup::tool_change;
    case 30:
    case 40:
    case 50:
      return MGroup::spindle;
    case 70:
    case 80:
    case 90:
      return MGroup::coolant;
    default:
      return std::nullopt;
  }
}

}  // namespace feedtwin::controllers::gcode
