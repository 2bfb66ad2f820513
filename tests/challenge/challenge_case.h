#pragma once
// One challenge case: what is hidden, the runs, the nominal axis that the user believes in, and the key.

#include <cstdint>
#include <string>
#include <vector>

#include "tests/challenge/catalogue.h"
#include "tests/challenge/closed_loop.h"
#include "tests/challenge/repeat.h"

namespace feedtwin::challenge {

/// What to make; every field left at its default is drawn from the seed.
struct Wish {
  std::uint64_t seed = 1;
  std::string kind;       ///< none, numbers, coloured, single, pair, triple, outside
  std::string effect;     ///< of kind single: this one
  double strength = 0.0;  ///< leftover of the effect over the leftover without it
};

struct NamedRun {
  std::string file;
  Run run;
};

struct Case {
  std::string kind;
  Axis truth, nominal;
  Effects effects;
  std::vector<const Hidden*> hidden;
  Noise noise;
  unsigned channels = all_channels;
  std::vector<NamedRun> fit, holdout;
  double wrong_by = 0.0;                    ///< spread of the nominal numbers
  std::vector<double> line_phases_rad;      ///< of each run
  bool masked = false;                      ///< nominal numbers were refitted to data that hold the effect
  double residual_N = 0.0, effect_N = 0.0;  ///< leftover without the effects, and what they add
  std::vector<ChannelFloor> floors;         ///< of the held-out run
};

[[nodiscard]] Case make_case(const Wish& wish);

/// Writes folder/case.toml, axis.toml and the runs, and the key as JSON.
void write_case(const Case& c, std::uint64_t seed, const std::string& folder, const std::string& key_file);

}  // namespace feedtwin::challenge
