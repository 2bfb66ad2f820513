#include "tools/machine/machine_recording.h"

#include <fmt/format.h>

#include <iterator>

#include "tools/config/whole_file.h"

namespace feedtwin::tools {

std::string machine_columns() {
  return "time_s,x_position_m,y_position_m,x_torque_cmd_Nm,y_torque_cmd_Nm,x_cutting_force_N,y_cutting_force_N,"
         "cutting_torque_Nm,spindle_speed_rad_per_s,removal_rate_mm3_per_s,pump_power_W,controller_power_W,spindle_power_W,"
         "feed_drive_power_W,power_W,pump_on,cutting";
}

std::string machine_row(const rt::MachineRecord& s) {
  std::string row;
  auto out = std::back_inserter(row);
  fmt::format_to(out, "{:.6f},{:.10g},{:.10g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.8g},{:.6g},", s.time_s, s.x_m, s.y_m,
                 s.x_torque_Nm, s.y_torque_Nm, s.force_x_N, s.force_y_N, s.cutting_torque_Nm, s.spindle_speed_rad_per_s,
                 s.removal_rate_m3_per_s * 1e9);
  fmt::format_to(out, "{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:d},{:d}", s.power.pump_W, s.power.controller_W,
                 s.power.spindle_W, s.power.feed_W, s.power.total_W(), s.pump_on ? 1 : 0, s.cutting ? 1 : 0);
  return row;
}

void write_machine_recording(const std::string& path, const std::vector<MachineSample>& samples) {
  std::string text = machine_columns() + ",x_reference_m,y_reference_m,contour_error_m\n";
  for (const auto& s : samples) {
    text += machine_row(s);
    fmt::format_to(std::back_inserter(text), ",{:.10g},{:.10g},{:.6g}\n", s.x_reference_m, s.y_reference_m,
                   s.contour_error_m);
  }
  write_whole_file(path, text);
}

}  // namespace feedtwin::tools
