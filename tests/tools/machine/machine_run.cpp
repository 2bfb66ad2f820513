#include "tools/machine/machine_run.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"
#include "tools/machine/job_keys.h"
#include "tools/machine/machine_json.h"
#include "tools/machine/source_program.h"
#include "tools/machine/sweep.h"

namespace feedtwin::tools {
namespace {

const std::string examples = FEEDTWIN_SOURCE_DIR "/controllers/gcode/examples/";

MachineJob job_for(const std::string& program) {
  MachineJob job = source_machine();
  job.program_name = "test.ngc";
  job.program_text = program;
  return job;
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MachineRun, TheExampleFilesAreTheBuiltInCases) {
  EXPECT_EQ(read_whole_file(examples + "channel.ngc"), source_program_A);
  EXPECT_EQ(read_whole_file(examples + "channel_saving.ngc"), source_program_B);
  const auto built_in = run_machine(source_machine()).energy,
             from_file = run_machine(read_job(examples + "channel.toml")).energy;
  EXPECT_DOUBLE_EQ(built_in.total_J(), from_file.total_J());
  EXPECT_DOUBLE_EQ(built_in.y.ball_screw_J, from_file.y.ball_screw_J);
  MachineJob b = source_machine();
  b.program_text = source_program_B;
  apply_setting(b, "spindle.motor=B");
  EXPECT_DOUBLE_EQ(run_machine(b).energy.total_J(),
                   run_machine(read_job(examples + "channel_saving.toml")).energy.total_J());
}

TEST(MachineRun, TheSourcesNumbersAreWithinFivePercent) {
  // section 4: case A and case B in kJ, spindle loss in cutting, shares, Eq. 15
  const auto a = run_machine(source_machine());
  EXPECT_NEAR(a.energy.auxiliary_J() / 730.0, 1.0, 0.05);
  EXPECT_NEAR(a.energy.spindle_J() / 270.0, 1.0, 0.05);
  EXPECT_NEAR(a.energy.total_J() / 1040.0, 1.0, 0.05);
  EXPECT_NEAR(a.cutting.spindle_W / 11.84, 1.0, 0.05);
  EXPECT_NEAR(a.before_cutting.servo_share() / 0.305, 1.0, 0.05);
  EXPECT_NEAR(a.cutting.servo_share() / 0.347, 1.0, 0.05);
  EXPECT_LT(a.peak_cutting_torque_Nm, 0.03);
  const auto job_b = read_job(examples + "channel_saving.toml");
  const auto b = run_machine(job_b);
  EXPECT_NEAR(b.energy.auxiliary_J() / 600.0, 1.0, 0.05);
  EXPECT_NEAR(b.energy.spindle_J() / 150.0, 1.0, 0.05);
  EXPECT_NEAR(b.energy.total_J() / 790.0, 1.0, 0.05);
  EXPECT_NEAR(b.cutting.spindle_W / 8.83, 1.0, 0.05);
  const auto fit = fit_specific_energy(run_sweep(job_b, {read_sweep_axis("process.mrr_mm3_per_s=1:10:10")}, 2));
  EXPECT_EQ(fit.points, 10U);
  EXPECT_NEAR(fit.a_W / 37.5, 1.0, 0.05);
  EXPECT_NEAR(fit.b_J_per_mm3 / 3.008, 1.0, 0.05);
}

TEST(MachineRun, ComponentsAddUpToTheInput) {
  for (const char* setting :
       {"tool.runout_m=5e-6", "cutting.regenerative=true", "spindle.motor=B", "auxiliary.pump_policy=cutting"}) {
    MachineJob job = source_machine();
    apply_setting(job, setting);
    const auto result = run_machine(job);
    EXPECT_LT(result.energy.balance_error(), 1e-9) << setting;  // asked for: 1e-3
    double sum = 0.0;
    for (const auto& [name, joules] : energy_by_component(result.energy)) sum += joules;
    EXPECT_NEAR(sum / result.energy.total_J(), 1.0, 1e-9) << setting;
    EXPECT_NEAR(result.energy.input_J / result.energy.total_J(), 1.0, 1e-9) << setting;
  }
}

TEST(MachineRun, PowersOfTheSamplesAddUpToTheEnergy) {
  const auto result = run_machine(source_machine(), 7);
  double joules = 0.0, last_s = 0.0;
  for (const auto& s : result.samples) {
    joules += s.power.total_W() * (s.time_s - last_s);
    last_s = s.time_s;
  }
  EXPECT_NEAR(joules / result.energy.total_J(), 1.0, 2e-3);
}

TEST(MachineRun, RegenerationChangesNothingForARigidTable) {
  MachineJob plain = source_machine(), regenerative = source_machine();
  apply_setting(regenerative, "cutting.regenerative=true");
  const double a = run_machine(plain).energy.spindle.cutting_J, b = run_machine(regenerative).energy.spindle.cutting_J;
  EXPECT_NE(a, b);
  EXPECT_NEAR(b / a, 1.0, 0.01);
}

TEST(MachineRun, ASlotsVolumeIsItsGeometry) {
  MachineJob job = job_for("S3000 M3\nG0 X0 Z-0.5\nG4 P1\nG1 X40 F300\nM2");
  const auto r = run_machine(job);
  const double length = 0.040 - 3.2e-3, R = 2e-3;
  const double volume = 0.5e-3 * (2 * R * length + 0.5 * 3.14159265358979 * R * R);
  EXPECT_NEAR(r.energy.removed_m3 / volume, 1.0, 2e-3);
}

TEST(MachineRun, PumpPoliciesDoWhatTheirNamesSay) {
  const auto pump_J = [](const char* policy) {
    MachineJob job = source_machine();
    apply_setting(job, std::string("auxiliary.pump_policy=") + policy);
    const auto r = run_machine(job);
    return std::pair(r.energy.pump_J, r);
  };
  const auto [always, run_always] = pump_J("always");
  EXPECT_NEAR(always, 10.0 * run_always.time_s, 1e-9);
  const auto [cutting, run_cutting] = pump_J("cutting");
  EXPECT_NEAR(cutting, 10.0 * run_cutting.cutting_time_s, 1e-9);
  EXPECT_LE(pump_J("commanded").first, always);
}

TEST(MachineRun, PushingIntoMaterialWithoutTheSpindleIsCounted) {
  const auto r = run_machine(job_for("G0 X0 Z-0.5\nG1 X10 F300\nM2"));
  EXPECT_GT(r.stalled_ticks, 1000);
  EXPECT_EQ(r.energy.spindle.cutting_J, 0.0);
}

TEST(MachineRun, AShorterTickChangesEnergiesLittle) {
  MachineJob fine = source_machine();
  apply_setting(fine, "controller.tick_s=0.5e-3");
  const auto a = run_machine(source_machine()).energy, b = run_machine(fine).energy;
  EXPECT_NEAR(b.total_J() / a.total_J(), 1.0, 1e-4);
  EXPECT_NEAR(b.spindle.cutting_J / a.spindle.cutting_J, 1.0, 2e-3);
  EXPECT_NEAR(b.x.ball_screw_J / a.x.ball_screw_J, 1.0, 5e-3);
}

TEST(MachineRun, AProgramsErrorNamesFileLineAndColumn) {
  const std::string message = message_of([] { (void)run_machine(job_for("G0 X1\nG1 X2 F100 G83\nM2")); });
  EXPECT_EQ(message, "test.ngc:2:12: G83 is not supported");
}

TEST(MachineRun, WrongSettingsAreOneClearLine) {
  MachineJob job = source_machine();
  const auto message = [&job](const std::string& setting) { return message_of([&] { apply_setting(job, setting); }); };
  EXPECT_NE(message("spindle.colour=red").find("spindle.colour: unknown key"), std::string::npos);
  EXPECT_NE(message("spindle.ke0_W=-1").find("expected a number from 0"), std::string::npos);
  EXPECT_NE(message("auxiliary.pump_policy=never").find("expected one of commanded"), std::string::npos);
  EXPECT_NE(message("tool.teeth=99").find("whole number"), std::string::npos);
  EXPECT_NE(message("no_value").find("expected KEY=VALUE"), std::string::npos);
  EXPECT_NE(message("workpiece.x_high_m=-1").find("no width"), std::string::npos);
  EXPECT_NE(message("program=/nowhere.ngc").find("cannot be opened"), std::string::npos);
  EXPECT_NE(message("x.motor.inertia_kgm2=heavy").find("expected a number"), std::string::npos);
}

TEST(MachineRun, EveryNumberKeyCanBeSet) {
  for (const auto& key : job_keys()) {
    MachineJob job = source_machine();
    const double was = key.in(job);
    const double wanted = was == 0.0 ? 0.5 * key.highest : 0.999 * was;  // stays in range and keeps the block a block
    apply_setting(job, fmt::format("{}={:.17g}", key.key, wanted));
    EXPECT_DOUBLE_EQ(key.in(job), wanted) << key.key;
  }
}

TEST(MachineRun, AnotherLeadCostsOtherJoules) {
  MachineJob job = source_machine();
  apply_setting(job, "x.axis.lead_m=0.01");
  const auto a = run_machine(source_machine()), b = run_machine(job);
  EXPECT_NE(a.energy.x.motor_mechanical_J, b.energy.x.motor_mechanical_J);
  EXPECT_DOUBLE_EQ(a.energy.pump_J, b.energy.pump_J);
}

TEST(Sweep, ReadsRangesAndLists) {
  EXPECT_EQ(read_sweep_axis("a.b=1:3:5").values, (std::vector<double>{1, 1.5, 2, 2.5, 3}));
  EXPECT_EQ(read_sweep_axis("a=2,4,-1").values, (std::vector<double>{2, 4, -1}));
  for (const char* wrong : {"a", "=1", "a=", "a=1:2:x", "a=1:2:1", "a=1:2:2.5", "a=1,,2", "a=1,nan"}) {
    EXPECT_THROW((void)read_sweep_axis(wrong), InputError) << wrong;
  }
}

TEST(Sweep, AGridHasEveryCombinationWhateverTheThreads) {
  MachineJob job = job_for("S3000 M3\nG0 X0 Z-0.2\nG4 P1\nG1 X6 F600\nM2");
  const std::vector<SweepAxis> axes{read_sweep_axis("process.feed_override=1,2"), read_sweep_axis("auxiliary.pump_W=1,2,3")};
  const auto one = run_sweep(job, axes, 1), four = run_sweep(job, axes, 4);
  ASSERT_EQ(one.size(), 6U);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].values, four[i].values);
    EXPECT_EQ(one[i].result.energy.total_J(), four[i].result.energy.total_J());
  }
  EXPECT_EQ(one[5].values, (std::vector<double>{2, 3}));
  EXPECT_THROW((void)run_sweep(job, {read_sweep_axis("no.key=1,2")}, 2), InputError);
}

TEST(Sweep, TheFitRecoversItsOwnLaw) {
  std::vector<SweepPoint> points(6);
  for (int i = 0; i < 6; ++i) {
    auto& r = points[static_cast<std::size_t>(i)].result;
    const double mrr = 1.0 + i;  // mm^3/s
    r.cutting_time_s = 10.0;
    r.energy.removed_m3 = mrr * 1e-8;
    r.energy.pump_J = (20.0 / mrr + 3.0) * mrr * 10.0;
  }
  const auto fit = fit_specific_energy(points);
  EXPECT_NEAR(fit.a_W, 20.0, 1e-9);
  EXPECT_NEAR(fit.b_J_per_mm3, 3.0, 1e-9);
  points.resize(1);
  EXPECT_EQ(fit_specific_energy(points).points, 0U);
}

TEST(MachineJson, HoldsTheContractsNames) {
  const auto json = to_json(run_machine(source_machine()));
  for (const char* name : {"pump", "controller", "spindle_electrical", "spindle_mechanical", "x_motor_electrical",
                           "x_motor_mechanical", "x_ball_screw", "x_guide", "y_guide", "total"}) {
    EXPECT_TRUE(json["energy_J"].contains(name)) << name;
  }
  EXPECT_TRUE(json["time_s"].is_number());
  EXPECT_TRUE(json["contour_error_m"].is_number());
}

}  // namespace
}  // namespace feedtwin::tools
