#pragma once
// What could stand in a name's place: what was in question when it came, with everything else refitted.

#include <optional>
#include <set>
#include <vector>

#include "tools/diagnose/screen.h"
#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

/// A name in its model.
struct Placed {
  const Fit& with;  ///< the model
  const Fit& less;  ///< without the effect
  std::size_t effect = 0;
  double gain = 0.0;                  ///< fall of the cost that it brings
  const std::vector<Score>& earlier;  ///< what else was in question when it came
};

/// What takes its place.
struct Exchange {
  Candidate model;
  const Score* by = nullptr;
};

/// A better one where there is one.
/// @param last what the model leaves over
/// @param never that gave way to another before: of two that are nearly one neither is put back in the other's place
/// @param[out] rivals gets those that fit as well
[[nodiscard]] std::optional<Exchange> exchanged(const Fitter& fitter, const Bar& bar, const Whitening& whitening,
                                                const Placed& named, const Screen& last,
                                                const std::set<const Hypothesis*>& never,
                                                std::vector<const Hypothesis*>& rivals);

}  // namespace feedtwin::tools::diagnosis
