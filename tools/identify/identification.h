#pragma once
// Identification of a case: everything together by output error, started from the axis file, and said what the data tell.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/identify/comparison.h"
#include "tools/identify/inverse_model.h"
#include "tools/identify/output_error.h"
#include "tools/recording/case.h"

namespace feedtwin::tools {

struct IdentificationSettings {
  bool force_offset = false;  ///< a constant force beside direction-dependent Coulomb friction
  OutputErrorSettings output_error;
};

struct Identification {
  plant::AxisParameters axis;  ///< the case's, with what was found
  OutputErrorFit fit;
  CaseComparison before, after;
  RigidFit rigid, rigid_directional;  ///< over the first recording, by the inverse model
  double seconds = 0.0;               ///< that the output error took
};

[[nodiscard]] Identification identify_case(const Case& recordings, const IdentificationSettings& settings = {});

/// Contract of `identify --json`, without the head.
[[nodiscard]] nlohmann::json to_json(const Identification& found);
[[nodiscard]] std::string to_text(const Identification& found);

}  // namespace feedtwin::tools
