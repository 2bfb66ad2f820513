#include "rt/machine_plant.h"

#include <algorithm>
#include <cmath>

namespace feedtwin::rt {
namespace {

/// A table slower than this has no direction of feed that could be told.
constexpr double standing_m_per_s = 1e-6;

}  // namespace

MachinePlant::MachinePlant(const plant::MachineParameters& machine, const plant::BlockParameters& block,
                           std::size_t record_capacity)
    : machine_(machine),
      block_(block),
      recording_(record_capacity > 0),
      records_(std::max<std::size_t>(1, record_capacity)) {}

double MachinePlant::process_force_N(std::size_t i) const noexcept {
  const auto& load = machine_.signals().cut;
  return i == 0 ? -load.force_x_N : -load.force_y_N;
}

plant::Engagement MachinePlant::engagement(const io::MachineRequest& request) const noexcept {
  if (request.path_engagement) return request.engagement;
  const auto& x = machine_.signals().x;
  const auto& y = machine_.signals().y;
  const bool over_block = x.position_m > block_.x_low_m && x.position_m < block_.x_high_m && y.position_m > block_.y_low_m &&
                          y.position_m < block_.y_high_m;
  if (!(request.depth_of_cut_m > 0.0) || !over_block) return {};
  if (std::hypot(x.velocity_m_per_s, y.velocity_m_per_s) < standing_m_per_s) return {};
  return plant::slot(request.depth_of_cut_m, std::atan2(y.velocity_m_per_s, x.velocity_m_per_s));
}

void MachinePlant::step(std::span<const double> torques_Nm, const io::MachineRequest& request, double tick_s) noexcept {
  plant::MachineCommand command;
  command.torque_x_Nm = torques_Nm[0];
  command.torque_y_Nm = torques_Nm[1];
  command.spindle_speed_rad_per_s = request.spindle_speed_rad_per_s;
  command.pump = request.pump;
  command.engagement = engagement(request);
  machine_.step(command, tick_s);
  if (recording_) record(command.engagement.cutting());
}

MachineRecord record_of(const plant::MachineSignals& s, const plant::MachineEnergy& last, const plant::MachineEnergy& now,
                        bool cutting) noexcept FEEDTWIN_REALTIME {
  MachineRecord row;
  row.time_s = now.time_s;
  row.x_m = s.x.position_m;
  row.y_m = s.y.position_m;
  row.x_torque_Nm = s.x.torque_Nm;
  row.y_torque_Nm = s.y.torque_Nm;
  row.force_x_N = s.cut.force_x_N;
  row.force_y_N = s.cut.force_y_N;
  row.cutting_torque_Nm = s.cut.torque_Nm;
  row.removal_rate_m3_per_s = s.cut.removal_rate_m3_per_s;
  row.spindle_speed_rad_per_s = s.spindle_speed_rad_per_s;
  row.power = plant::mean_power(last, now);
  row.pump_on = s.pump_on;
  row.cutting = cutting;
  return row;
}

void MachinePlant::record(bool cutting) noexcept {
  const plant::MachineEnergy now = machine_.energy();
  if (!records_.push(record_of(machine_.signals(), last_energy_, now, cutting))) ++dropped_records_;
  last_energy_ = now;
}

}  // namespace feedtwin::rt
