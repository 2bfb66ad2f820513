#include "tools/machine/job.h"

#include "plant/parameter_table.h"
#include "tools/machine/source_program.h"

namespace feedtwin::tools {

controllers::CascadeGains cascade_of(const LoopGains& loop, const plant::AxisParameters& axis) {
  const plant::AxisModel<double> model = plant::make_axis_model(axis);
  const auto mean = [](const plant::Directional& d) { return 0.5 * (d.pos + d.neg); };
  controllers::CascadeGains gains;
  gains.position_per_s = loop.position_per_s;
  gains.velocity_Ns_per_m = loop.velocity_Ns_per_m;
  gains.velocity_integral_N_per_m = loop.velocity_integral_N_per_m;
  gains.current_loop_time_constant_s = loop.current_loop_time_constant_s;
  gains.acceleration_feedforward_kg = model.mass_kg;
  gains.friction_feedforward_N = mean(axis.motor.coulomb_N) + mean(axis.ball_screw.coulomb_N) + mean(axis.guide.coulomb_N);
  gains.viscous_feedforward_Ns_per_m = 0.5 * (model.damping_pos_Ns_per_m + model.damping_neg_Ns_per_m) +
                                       mean(axis.ball_screw.viscous_Ns_per_m) + mean(axis.guide.viscous_Ns_per_m);
  gains.torque_limit_Nm = axis.axis.torque_limit_Nm;
  gains.lead_m = axis.axis.lead_m;
  return gains;
}

MachineJob source_machine() {
  MachineJob job;
  job.name = "the source's machine, case A";
  job.machine.x = plant::source_axis();  // Table 2
  job.machine.y = plant::source_axis();
  job.machine.y.guide_mass_kg = 12.0;  // the lower slide carries the upper axis
  job.machine.spindle = plant::spindle_motor_A();
  job.machine.tool = {.diameter_m = 4e-3, .teeth = 2, .helix_rad = 0.5236};
  // an engineering plastic: 0.19 J/mm^3 at the programmed chip load
  job.machine.cutting = {.Ktc_N_per_m2 = 160e6,
                         .Krc_N_per_m2 = 50e6,
                         .Kac_N_per_m2 = 20e6,
                         .Kte_N_per_m = 1.1e3,
                         .Kre_N_per_m = 1.0e3,
                         .Kae_N_per_m = 0.0};
  job.limits = {{0.1, 0.1, 0.05}, {1.0, 1.0, 1.0}, {50.0, 50.0, 50.0}};
  job.block = {.x_low_m = 3.2e-3, .x_high_m = 60e-3, .y_low_m = -10e-3, .y_high_m = 30e-3, .top_m = 0.0};
  job.program_name = "channel.ngc";
  job.program_text = source_program_A;
  return job;
}

}  // namespace feedtwin::tools
