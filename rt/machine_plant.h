#pragma once
// The whole machine tool as the plant that the loop steps: axis 0 is x, axis 1 is y; spindle, pump and depth of cut come
// beside the torques (io::MachineRequest). Its rows of the log go through a ring of their own.

#include <cstdint>

#include "plant/machine/machine.h"
#include "plant/machine/workpiece.h"
#include "rt/spsc_ring.h"
#include "rt/stepped_plant.h"

namespace feedtwin::rt {

/// The machine at the end of a tick; powers are means since the last record.
struct MachineRecord {
  double time_s = 0.0;
  double x_m = 0.0, y_m = 0.0, x_torque_Nm = 0.0, y_torque_Nm = 0.0;
  double force_x_N = 0.0, force_y_N = 0.0, cutting_torque_Nm = 0.0, removal_rate_m3_per_s = 0.0;
  double spindle_speed_rad_per_s = 0.0;
  plant::ComponentPower power;
  bool pump_on = false, cutting = false;
};

/// @param last the energies that the powers count from
[[nodiscard]] MachineRecord record_of(const plant::MachineSignals& signals, const plant::MachineEnergy& last,
                                      const plant::MachineEnergy& now, bool cutting) noexcept FEEDTWIN_REALTIME;

class MachinePlant final : public SteppedPlant {
 public:
  /// @param record_capacity rows between the tick and the writer; 0: no rows are made
  MachinePlant(const plant::MachineParameters& machine, const plant::BlockParameters& block, std::size_t record_capacity);

  [[nodiscard]] std::size_t axes() const noexcept FEEDTWIN_REALTIME override { return 2; }
  [[nodiscard]] const plant::FeedAxis& axis(std::size_t i) const noexcept FEEDTWIN_REALTIME override {
    return i == 0 ? machine_.x() : machine_.y();
  }
  [[nodiscard]] double process_force_N(std::size_t i) const noexcept FEEDTWIN_REALTIME override;
  void step(std::span<const double> torques_Nm, const io::MachineRequest& request,
            double tick_s) noexcept FEEDTWIN_REALTIME override;

  [[nodiscard]] const plant::Machine& machine() const noexcept { return machine_; }
  [[nodiscard]] SpscRing<MachineRecord>& records() noexcept { return records_; }
  [[nodiscard]] std::uint64_t dropped_records() const noexcept { return dropped_records_; }

 private:
  /// A slot of the wanted depth where the tool stands over the block and moves; the path's own engagement where it is known.
  [[nodiscard]] plant::Engagement engagement(const io::MachineRequest& request) const noexcept FEEDTWIN_REALTIME;
  void record(bool cutting) noexcept FEEDTWIN_REALTIME;

  plant::Machine machine_;
  plant::BlockParameters block_;
  bool recording_;
  SpscRing<MachineRecord> records_;
  std::uint64_t dropped_records_ = 0;
  plant::MachineEnergy last_energy_;
};

}  // namespace feedtwin::rt
