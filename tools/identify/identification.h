#pragma once
// Identification of a case: everything together by output error, started from the axis file, and said what the data tell.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "tools/identify/comparison.h"
#include "tools/identify/inverse_model.h"
#include "tools/identify/output_error.h"
#include "tools/identify/stages/staged.h"
#include "tools/recording/case.h"

namespace feedtwin::tools {

/// Where the fit of everything together starts from.
enum class Method {
  staged,      ///< the source's stages, each in closed form but for one number
  genetic,     ///< the same stages by the source's genetic algorithm
  population,  ///< a genetic algorithm over everything at once, on closed-loop simulation in lanes, begun at the stages'
               ///< result
  joint,       ///< the axis file
};
struct MethodName {
  std::string_view name, meaning;
  Method method;
};
[[nodiscard]] std::span<const MethodName> method_names() noexcept;

struct IdentificationSettings {
  Method method = Method::staged;
  GeneticSettings population{.population = 256, .most_generations = 60, .stall_generations = 15, .tolerance = 1e-3};
  bool force_offset = false;  ///< a constant force beside direction-dependent Coulomb friction
  OutputErrorSettings output_error;
};

struct Identification {
  plant::AxisParameters axis;  ///< the case's, with what was found
  Method method = Method::staged;
  StagedFit stages;
  bool started_from_stages = false;
  long population_evaluations = 0;
  OutputErrorFit fit;
  CaseComparison before, after;
  RigidFit rigid, rigid_directional;                                    ///< over the first recording, by the inverse model
  double stage_seconds = 0.0, population_seconds = 0.0, seconds = 0.0;  ///< the last: of the output error
};

[[nodiscard]] Identification identify_case(const Case& recordings, const IdentificationSettings& settings = {});

/// Contract of `identify --json`, without the head. Of a parameter, `ci90` holds the truth in 90 % of repeats, whatever the
/// others' do; all parameters' `joint_ci90` hold at once in 90 %.
[[nodiscard]] nlohmann::json to_json(const Identification& found);
[[nodiscard]] std::string to_text(const Identification& found);

}  // namespace feedtwin::tools
