#include "tools/identify/axis_unknowns.h"

#include <algorithm>
#include <cmath>

#include "plant/parameter_table.h"
#include "tools/identify/channel_residuals.h"

namespace feedtwin::tools {
namespace {

constexpr double undivided_prior = 0.1;

bool electrical(std::string_view key) {
  return key.starts_with("motor.ke");
}

/// The same number for the other direction of motion.
std::string mirrored(std::string_view key) {
  std::string other(key);
  const auto pos = other.find("_pos_"), neg = other.find("_neg_");
  if (pos != std::string::npos) other.replace(pos, 5, "_neg_");
  if (neg != std::string::npos) other.replace(neg, 5, "_pos_");
  return other;
}

/// What a change of a number is measured by: its size, or that of its counterpart, or what such numbers are on the source's
/// axis.
double scale_of(const plant::ParameterEntry& entry, plant::AxisParameters nominal) {
  plant::AxisParameters source = plant::source_axis();
  double scale = std::abs(entry.in(nominal));
  if (const auto* other = plant::find_parameter(mirrored(entry.key))) scale = std::max(scale, std::abs(other->in(nominal)));
  return scale > 0.0 ? scale : std::abs(entry.in(source));
}

void keep_breakaway(plant::LugreParameters& friction) {
  friction.static_N.pos = std::max(friction.static_N.pos, friction.coulomb_N.pos);
  friction.static_N.neg = std::max(friction.static_N.neg, friction.coulomb_N.neg);
}

}  // namespace

std::vector<FitParameter> axis_unknowns(const plant::AxisParameters& nominal, const std::vector<Recording>& recordings,
                                        bool with_force_offset) {
  plant::AxisParameters axis = nominal;
  const auto recorded = [&recordings](std::string_view name) {
    return std::ranges::any_of(recordings, [name](const Recording& r) { return r.has(name); });
  };
  const bool power = recorded(channel::power_W), torque_sensor = recorded(channel::torque_sensor_Nm);
  const bool force_sensor = recorded(channel::force_sensor_N);
  std::vector<FitParameter> unknowns;
  for (const auto& entry : plant::parameter_table()) {
    const bool motor = entry.key.starts_with("motor."), guide = entry.key.starts_with("guide.");
    if (!motor && !guide && !entry.key.starts_with("ball_screw.")) continue;
    if (entry.key == "motor.rated_torque_Nm" || (electrical(entry.key) && !power)) continue;
    const double value = entry.in(axis), scale = scale_of(entry, nominal), reach = 20.0 * scale;
    const double low = entry.lowest < 0.0 ? -reach : entry.lowest > 0.0 ? 1e-3 * scale : 0.0;
    FitParameter unknown{std::string(entry.key), value, std::max(entry.lowest, low), std::min(entry.highest, reach), scale};
    // no sensor divides these from the ball screw: they stay by the axis file unless the motion says much
    if ((guide && !force_sensor) || (motor && !torque_sensor && !electrical(entry.key))) unknown.prior = undivided_prior;
    unknowns.push_back(std::move(unknown));
  }
  const double count_m = nominal.axis.lead_m / nominal.axis.encoder_counts_per_rev;
  unknowns.push_back({position_offset_key, 0.0, -5.0 * count_m, 5.0 * count_m, count_m});
  for (const auto& recording : recordings)
    unknowns.push_back({std::string(start_offset_key) + recording.file, 0.0, -2.0 * count_m, 2.0 * count_m, count_m});
  if (with_force_offset) {
    const double scale = 0.2 * (nominal.ball_screw.coulomb_N.pos + nominal.ball_screw.coulomb_N.neg);
    unknowns.push_back({force_offset_key, 0.0, -10.0 * scale, 10.0 * scale, scale});
  }
  return unknowns;
}

void start_from(std::vector<FitParameter>& unknowns, const plant::AxisParameters& axis) {
  plant::AxisParameters from = axis;
  for (auto& unknown : unknowns) {
    if (const auto* entry = plant::find_parameter(unknown.key))
      unknown.start = std::clamp(entry->in(from), unknown.lowest, unknown.highest);
  }
}

CandidateAxis axis_at(const plant::AxisParameters& nominal, const std::vector<FitParameter>& unknowns,
                      const Eigen::VectorXd& point, std::string_view file) {
  CandidateAxis candidate{nominal};
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const double value = point[static_cast<Eigen::Index>(i)];
    if (unknowns[i].key == position_offset_key) {
      candidate.position_offset_m = value;
    } else if (unknowns[i].key == force_offset_key) {
      candidate.force_offset_N = value;
    } else if (unknowns[i].key.starts_with(start_offset_key)) {
      if (std::string_view(unknowns[i].key).substr(start_offset_key.size()) == file) candidate.start_offset_m = value;
    } else {
      plant::find_parameter(unknowns[i].key)->in(candidate.parameters) = value;
    }
  }
  keep_breakaway(candidate.parameters.ball_screw);
  keep_breakaway(candidate.parameters.guide);
  return candidate;
}

BatchSimulator lane_simulator(const plant::AxisParameters& nominal, const std::vector<FitParameter>& unknowns) {
  return [nominal, unknowns](const ClosedLoopRun& run, const Eigen::MatrixXd& points) {
    std::vector<CandidateAxis> candidates;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      candidates.push_back(axis_at(nominal, unknowns, points.col(i), run.recording().file));
    return simulate_closed_loop(run, candidates, wanted_for(run.recording()));
  };
}

}  // namespace feedtwin::tools
