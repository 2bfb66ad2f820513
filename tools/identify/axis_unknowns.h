#pragma once
// The unknowns of the paper's model: which numbers of an axis file a set of recordings could tell, and their simulation in
// lanes.

#include <string_view>
#include <vector>

#include "plant/parameters.h"
#include "tools/identify/output_error.h"

namespace feedtwin::tools {

/// Names of the nuisances that are no numbers of an axis file.
inline constexpr const char* position_offset_key = "nuisance.position_offset_m";
inline constexpr const char* force_offset_key = "nuisance.force_offset_N";
/// Followed by the recording's file: each run starts somewhere else within a count, and in pre-sliding a count is newtons.
inline constexpr std::string_view start_offset_key = "nuisance.start_offset_m ";

/// Everything but transmission, limits and rated torque; electrical coefficients only where power was recorded. The
/// encoder's rounding offset always; a constant force only with `with_force_offset`, for it is one with Coulomb asymmetry.
[[nodiscard]] std::vector<FitParameter> axis_unknowns(const plant::AxisParameters& nominal,
                                                      const std::vector<Recording>& recordings,
                                                      bool with_force_offset = false);

/// The same unknowns, started from another axis's numbers.
void start_from(std::vector<FitParameter>& unknowns, const plant::AxisParameters& axis);

/// The nominal axis with the unknowns put in; breakaway friction never below Coulomb friction.
/// @param file of the run that is simulated; empty: none in particular
[[nodiscard]] CandidateAxis axis_at(const plant::AxisParameters& nominal, const std::vector<FitParameter>& unknowns,
                                    const Eigen::VectorXd& point, std::string_view file = {});

[[nodiscard]] BatchSimulator lane_simulator(const plant::AxisParameters& nominal, const std::vector<FitParameter>& unknowns);

}  // namespace feedtwin::tools
