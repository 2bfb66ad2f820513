#pragma once
// The source's staged procedure (section 3.2): (a) electrical loss, (b) motor, (c) sliding and (d) pre-sliding friction of
// ball screw and guide, each from what its own sensors say. What has no sensor stays as the axis file has it; without torque
// and force sensors the torque command's sliding part as a whole is given to the ball screw.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plant/parameters.h"
#include "tools/identify/stages/electrical_loss.h"
#include "tools/identify/stages/hysteresis.h"
#include "tools/identify/stages/stribeck_curve.h"
#include "tools/recording/recording.h"

namespace feedtwin::tools {

/// Ball screw or guide: its Stribeck curves with what was fitted to them.
struct ContactStages {
  std::string component;
  StribeckCurve curve_pos, curve_neg;
  std::optional<StribeckFit> sliding_pos, sliding_neg;
  std::optional<HysteresisFit> presliding;
};

struct StagedFit {
  plant::AxisParameters axis;  ///< the nominal one with what the stages found
  std::optional<ElectricalLossFit> electrical;
  bool motor_found = false;
  std::vector<ContactStages> contacts;
  std::vector<std::string> keys;   ///< of plant/parameter_table that a stage has set
  std::vector<std::string> notes;  ///< stages that had nothing to go by
};

/// How stages (c) and (d) search.
enum class StageSearch { projected, genetic };

[[nodiscard]] StagedFit identify_by_stages(const plant::AxisParameters& nominal, std::span<const Recording> recordings,
                                           StageSearch search = StageSearch::projected);

}  // namespace feedtwin::tools
