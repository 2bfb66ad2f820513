#pragma once
// Effects that a case can hide, each with the numbers that its key reports, by the names of the public contract.

#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/challenge/truth.h"

namespace feedtwin::challenge {

enum Channel : unsigned { none = 0, scale = 1, torque_sensor = 2, force_sensor = 4, power = 8, all_channels = 15 };

/// What the undisturbed runs of a case reach; effects that act at a limit are placed by it.
struct Reach {
  double position_m = 0.04, torque_Nm = 0.4;
};

using Numbers = std::vector<std::pair<std::string, double>>;

struct Hidden {
  std::string id;
  unsigned needs = none;       ///< channels without which it can't be told apart
  bool seen_in_torque = true;  ///< strength is set by what it leaves in the torque command
  bool wants_dwell = false;
  double low, high;  ///< of the strength
  /// Sets the effect; draws its shape from `shape`, the same for every strength.
  void (*set)(Effects& e, double strength, std::mt19937_64 shape, const Reach& reach);
  Numbers (*numbers)(const Effects& e);
  std::vector<std::string> alike = {};  ///< ids that channels fewer than all can't tell from it
  bool number_only = false;             ///< a number of the nominal model: `recalibrate` is right too
};

[[nodiscard]] const std::vector<Hidden>& catalogue();
/// Structures that no catalogue names.
[[nodiscard]] const std::vector<Hidden>& outside();
/// True where these channels tell it from everything in `alike`; elsewhere a small set is the right answer.
[[nodiscard]] bool identifiable(const Hidden& hidden, unsigned channels);
/// nullptr where there is none of that id.
[[nodiscard]] const Hidden* find_hidden(const std::string& id);

}  // namespace feedtwin::challenge
