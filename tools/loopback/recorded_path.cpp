#include "tools/loopback/recorded_path.h"

#include <algorithm>
#include <numbers>

#include "tools/identify/closed_loop.h"

namespace feedtwin::tools {
namespace {

/// The recorded motion itself. Its speed is the mean over as many rows as the measured one's window, so that both are of the
/// same time; the command is fed forward, so that nothing is left to do where the axis is the recorded one.
std::vector<controllers::Reference> as_it_went(const Recording& recording, double lead_m) {
  constexpr std::size_t window{stand_in_window_samples};
  const auto position_m = recording.at(channel::position_m), torque_Nm = recording.at(channel::torque_cmd_Nm);
  std::vector<controllers::Reference> rows(position_m.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t before = k - std::min(k, window);
    rows[k].position_m = position_m[k];
    rows[k].velocity_m_per_s = (position_m[k] - position_m[before]) / (static_cast<double>(window) * recording.sample_s);
    if (!torque_Nm.empty()) rows[k].force_N = torque_Nm[k] * 2.0 * std::numbers::pi / lead_m;
  }
  return rows;
}

/// What is asked for in one tick acts in the next, on what the encoder showed at that one's start.
std::shared_ptr<const controllers::RecordedPath> one_tick_ahead(std::vector<controllers::Reference> rows, double tick_s) {
  auto path = std::make_shared<controllers::RecordedPath>();
  path->step_s = tick_s;
  std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  rows.back() = {.position_m = rows[rows.size() - 2].position_m};
  path->points = std::move(rows);
  return path;
}

}  // namespace

std::shared_ptr<const controllers::RecordedPath> recorded_reference(const Recording& recording) {
  return one_tick_ahead(with_derivatives(recording.at(channel::reference_m), recording.sample_s), recording.sample_s);
}

std::shared_ptr<const controllers::RecordedPath> recorded_motion_path(const Recording& recording, double lead_m) {
  return one_tick_ahead(as_it_went(recording, lead_m), recording.sample_s);
}

}  // namespace feedtwin::tools
