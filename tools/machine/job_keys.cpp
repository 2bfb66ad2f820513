#include "tools/machine/job_keys.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "plant/parameter_table.h"
#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {
namespace {

using J = MachineJob;

// clang-format off: a line a key
constexpr std::array job_table{
    JobKey{"spindle.inertia_kgm2", [](J& j) -> double& { return j.machine.spindle.inertia_kgm2; }, 1e-9, 10.0, "J_M, Table 5"},
    JobKey{"spindle.ke0_W", [](J& j) -> double& { return j.machine.spindle.ke0_W; }, 0.0, 1e5, "k_e0, Table 5"},
    JobKey{"spindle.ke1_Ws_per_rad", [](J& j) -> double& { return j.machine.spindle.ke1_Ws_per_rad; }, 0.0, 1e3, "k_e1, Table 5"},
    JobKey{"spindle.ke2_Ws2_per_rad2", [](J& j) -> double& { return j.machine.spindle.ke2_Ws2_per_rad2; }, 0.0, 10.0, "k_e2, Table 5, a thousandth of the print"},
    JobKey{"spindle.coulomb_Nm", [](J& j) -> double& { return j.machine.spindle.coulomb_Nm; }, 0.0, 100.0, "D_M, Table 5"},
    JobKey{"spindle.viscous_Nms", [](J& j) -> double& { return j.machine.spindle.viscous_Nms; }, 0.0, 10.0, "mu_v, Table 5"},
    JobKey{"spindle.torque_limit_Nm", [](J& j) -> double& { return j.machine.spindle.torque_limit_Nm; }, 1e-4, 1e4, "the drive's torque limit"},
    JobKey{"spindle.acceleration_rad_per_s2", [](J& j) -> double& { return j.machine.spindle.acceleration_rad_per_s2; }, 1.0, 1e6, "ramp of the commanded speed"},
    JobKey{"spindle.bandwidth_rad_per_s", [](J& j) -> double& { return j.machine.spindle.bandwidth_rad_per_s; }, 1.0, 500.0, "of the drive's speed loop"},
    JobKey{"auxiliary.pump_W", [](J& j) -> double& { return j.machine.auxiliary.pump_W; }, 0.0, 1e6, "lubricant pump while it runs"},
    JobKey{"auxiliary.controller_W", [](J& j) -> double& { return j.machine.auxiliary.controller_W; }, 0.0, 1e6, "controller, always"},
    JobKey{"tool.diameter_m", [](J& j) -> double& { return j.machine.tool.diameter_m; }, 1e-5, 1.0, "flat-end mill"},
    JobKey{"tool.helix_rad", [](J& j) -> double& { return j.machine.tool.helix_rad; }, 0.0, 1.3, "helix angle"},
    JobKey{"tool.runout_m", [](J& j) -> double& { return j.machine.tool.runout_m; }, 0.0, 1e-3, "radial run-out"},
    JobKey{"tool.runout_angle_rad", [](J& j) -> double& { return j.machine.tool.runout_angle_rad; }, -10.0, 10.0, "direction of the run-out from tooth 0"},
    JobKey{"cutting.Ktc_N_per_m2", [](J& j) -> double& { return j.machine.cutting.Ktc_N_per_m2; }, 0.0, 1e11, "tangential cutting coefficient"},
    JobKey{"cutting.Krc_N_per_m2", [](J& j) -> double& { return j.machine.cutting.Krc_N_per_m2; }, 0.0, 1e11, "radial cutting coefficient"},
    JobKey{"cutting.Kac_N_per_m2", [](J& j) -> double& { return j.machine.cutting.Kac_N_per_m2; }, 0.0, 1e11, "axial cutting coefficient"},
    JobKey{"cutting.Kte_N_per_m", [](J& j) -> double& { return j.machine.cutting.Kte_N_per_m; }, 0.0, 1e8, "tangential edge coefficient"},
    JobKey{"cutting.Kre_N_per_m", [](J& j) -> double& { return j.machine.cutting.Kre_N_per_m; }, 0.0, 1e8, "radial edge coefficient"},
    JobKey{"cutting.Kae_N_per_m", [](J& j) -> double& { return j.machine.cutting.Kae_N_per_m; }, 0.0, 1e8, "axial edge coefficient"},
    JobKey{"workpiece.x_low_m", [](J& j) -> double& { return j.block.x_low_m; }, -10.0, 10.0, "the block, machine coordinates"},
    JobKey{"workpiece.x_high_m", [](J& j) -> double& { return j.block.x_high_m; }, -10.0, 10.0, "the block"},
    JobKey{"workpiece.y_low_m", [](J& j) -> double& { return j.block.y_low_m; }, -10.0, 10.0, "the block"},
    JobKey{"workpiece.y_high_m", [](J& j) -> double& { return j.block.y_high_m; }, -10.0, 10.0, "the block"},
    JobKey{"workpiece.top_m", [](J& j) -> double& { return j.block.top_m; }, -10.0, 10.0, "height of the block's face"},
    JobKey{"controller.tick_s", [](J& j) -> double& { return j.tick_s; }, 1e-5, 1e-2, "period of the control loop"},
    JobKey{"controller.blend_tolerance_m", [](J& j) -> double& { return j.blend_tolerance_m; }, 1e-9, 1e-2, "corner rounding in force at the start and after a G64 without P"},
    JobKey{"x.limits.speed_m_per_s", [](J& j) -> double& { return j.limits.speed_m_per_s.x; }, 1e-4, 10.0, "rapid"},
    JobKey{"x.limits.acceleration_m_per_s2", [](J& j) -> double& { return j.limits.acceleration_m_per_s2.x; }, 1e-2, 1e3, "interpolator's limit"},
    JobKey{"x.limits.jerk_m_per_s3", [](J& j) -> double& { return j.limits.jerk_m_per_s3.x; }, 1e-1, 1e6, "interpolator's limit"},
    JobKey{"y.limits.speed_m_per_s", [](J& j) -> double& { return j.limits.speed_m_per_s.y; }, 1e-4, 10.0, "rapid"},
    JobKey{"y.limits.acceleration_m_per_s2", [](J& j) -> double& { return j.limits.acceleration_m_per_s2.y; }, 1e-2, 1e3, "interpolator's limit"},
    JobKey{"y.limits.jerk_m_per_s3", [](J& j) -> double& { return j.limits.jerk_m_per_s3.y; }, 1e-1, 1e6, "interpolator's limit"},
    JobKey{"z.limits.speed_m_per_s", [](J& j) -> double& { return j.limits.speed_m_per_s.z; }, 1e-4, 10.0, "rapid; the z axis has no drive model and follows exactly"},
    JobKey{"z.limits.acceleration_m_per_s2", [](J& j) -> double& { return j.limits.acceleration_m_per_s2.z; }, 1e-2, 1e3, "interpolator's limit"},
    JobKey{"z.limits.jerk_m_per_s3", [](J& j) -> double& { return j.limits.jerk_m_per_s3.z; }, 1e-1, 1e6, "interpolator's limit"},
    JobKey{"x.loop.position_per_s", [](J& j) -> double& { return j.x_loop.position_per_s; }, 0.1, 1e3, "Kv"},
    JobKey{"x.loop.velocity_Ns_per_m", [](J& j) -> double& { return j.x_loop.velocity_Ns_per_m; }, 0.0, 1e7, "velocity loop"},
    JobKey{"x.loop.velocity_integral_N_per_m", [](J& j) -> double& { return j.x_loop.velocity_integral_N_per_m; }, 0.0, 1e9, "velocity loop"},
    JobKey{"x.loop.current_time_constant_s", [](J& j) -> double& { return j.x_loop.current_loop_time_constant_s; }, 0.0, 0.1, "current loop; 0: ideal"},
    JobKey{"y.loop.position_per_s", [](J& j) -> double& { return j.y_loop.position_per_s; }, 0.1, 1e3, "Kv"},
    JobKey{"y.loop.velocity_Ns_per_m", [](J& j) -> double& { return j.y_loop.velocity_Ns_per_m; }, 0.0, 1e7, "velocity loop"},
    JobKey{"y.loop.velocity_integral_N_per_m", [](J& j) -> double& { return j.y_loop.velocity_integral_N_per_m; }, 0.0, 1e9, "velocity loop"},
    JobKey{"y.loop.current_time_constant_s", [](J& j) -> double& { return j.y_loop.current_loop_time_constant_s; }, 0.0, 0.1, "current loop; 0: ideal"},
    JobKey{"process.feed_override", [](J& j) -> double& { return j.feed_override; }, 1e-3, 1e3, "on every programmed feed"},
    JobKey{"process.spindle_override", [](J& j) -> double& { return j.spindle_override; }, 1e-3, 1e3, "on every programmed spindle speed"},
    JobKey{"process.mrr_mm3_per_s", [](J& j) -> double& { return j.removal_rate_mm3_per_s; }, 0.0, 1e6, "removal rate; feed and speed are scaled to it at constant chip load; 0: as programmed"},
};
// clang-format on

std::string beside(const std::string& file, const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() ? path : (std::filesystem::path(file).parent_path() / given).string();
}

/// [x] and [y]: an axis file as the base, single keys on top.
void apply_axis(plant::AxisParameters& axis, TomlFile& file, const std::string& letter) {
  if (const auto path = file.text(letter + ".file")) axis = read_axis_file(beside(file.path(), *path));
  for (const auto& entry : plant::parameter_table()) {
    double& value = entry.in(axis);
    value = file.number(letter + "." + std::string(entry.key), entry.lowest, entry.highest, value);
  }
}

void check(const MachineJob& job, const TomlFile& file) {
  if (job.block.x_low_m >= job.block.x_high_m)
    file.fail("workpiece.x_high_m", "the block has no width: x_high_m is not above x_low_m");
  if (job.block.y_low_m >= job.block.y_high_m)
    file.fail("workpiece.y_high_m", "the block has no width: y_high_m is not above y_low_m");
}

}  // namespace

std::span<const JobKey> job_keys() noexcept {
  return job_table;
}

void apply_known(MachineJob& job, TomlFile& file) {
  apply_axis(job.machine.x, file, "x");
  apply_axis(job.machine.y, file, "y");
  if (file.has("spindle.motor")) {  // before single keys of the spindle
    job.machine.spindle =
        file.word("spindle.motor", {"A", "B"}, "A") == "A" ? plant::spindle_motor_A() : plant::spindle_motor_B();
  }
  for (const auto& key : job_table) key.in(job) = file.number(key.key, key.lowest, key.highest, key.in(job));
  job.machine.tool.teeth =
      static_cast<int>(file.integer("tool.teeth", 1, plant::MillingForce::most_teeth, job.machine.tool.teeth));
  if (file.has("auxiliary.pump_policy")) {
    const std::string word = file.word("auxiliary.pump_policy", {"commanded", "always", "cutting"}, "commanded");
    job.machine.auxiliary.pump_policy = word == "commanded" ? plant::PumpPolicy::commanded
                                        : word == "always"  ? plant::PumpPolicy::always
                                                            : plant::PumpPolicy::cutting;
  }
  job.machine.regenerative = file.boolean("cutting.regenerative", job.machine.regenerative);
  job.interpreter.block_delete = file.boolean("controller.block_delete", job.interpreter.block_delete);
  const auto offsets = file.numbers("controller.g54_mm", -1e4, 1e4);
  if (!offsets.empty() && offsets.size() != 3) file.fail("controller.g54_mm", "expected three numbers, x y z");
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    job.interpreter.parameters.numbered[controllers::gcode::first_offset_parameter + i] = offsets[i];
  }
  if (const auto path = file.text("program")) {
    job.program_name = beside(file.path(), *path);
    job.program_text = read_whole_file(job.program_name);
  }
  check(job, file);
}

void apply(MachineJob& job, TomlFile& file) {
  apply_known(job, file);
  file.reject_unknown();
}

bool is_machine_file(const TomlFile& file) {
  for (const char* key : {"program", "x", "y", "spindle", "auxiliary", "tool", "cutting", "workpiece"}) {
    if (file.has(key)) return true;
  }
  return false;
}

MachineJob read_job(const std::string& path) {
  MachineJob job = source_machine();
  if (path.empty()) return job;
  job.name = path;
  TomlFile file = TomlFile::read(path);
  apply(job, file);
  return job;
}

void apply_setting(MachineJob& job, const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError("--set " + setting, 0, "", "expected KEY=VALUE");
  const std::string key = setting.substr(0, equals), value = setting.substr(equals + 1);
  const bool word = !value.empty() && value != "true" && value != "false" &&
                    value.find_first_not_of("0123456789+-.eE_[], ") != std::string::npos && value.front() != '"';
  TomlFile file = TomlFile::parse(key + " = " + (word ? "\"" + value + "\"" : value) + "\n", "--set " + key);
  apply(job, file);
}

}  // namespace feedtwin::tools
