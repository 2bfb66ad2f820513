#pragma once
// What is left over beyond chance and yet too little to be named, or named by one engine and not borne out by the other: the
// recordings cannot tell.

#include <functional>
#include <string_view>
#include <vector>

#include "tools/diagnose/search.h"

namespace feedtwin::tools::diagnosis {

struct Suspect {
  const Hypothesis* hypothesis = nullptr;
  Candidate model;             ///< with the suspect fitted, as its last effect
  double strength = 0.0;       ///< as in Found
  double p_false_alarm = 1.0;  ///< over all hypotheses together
};

/// Strongest first. Only what unseen folds bear out and what the nominal numbers could not do as well.
[[nodiscard]] std::vector<Suspect> suspects(const Fitter& fitter, const SearchResult& found, const Fit& fit,
                                            const std::function<void(std::string_view)>& progress);

}  // namespace feedtwin::tools::diagnosis
