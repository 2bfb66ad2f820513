#include "tools/machine/program_port.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/allocation_guard.h"
#include "tools/config/input_error.h"
#include "tools/config/server_config.h"
#include "tools/config/whole_file.h"
#include "tools/machine/machine_run.h"
#include "tools/recording/csv.h"
#include "tools/run/plant_run.h"

namespace feedtwin::tools {
namespace {

const std::string example = FEEDTWIN_SOURCE_DIR "/systemd/examples/machine.toml";

TEST(ProgramPort, TheMachineUnderTheServersLoopIsTheMachineVerbsToTheLastBit) {
  ServerConfig config = read_server_config({.path = example, .with_ports = false});
  ASSERT_EQ(config.controller, "program");
  config.log_path = (std::filesystem::temp_directory_path() / "feedtwin_program_port.csv").string();
  const std::string log = config.log_path;
  const MachineResult alone = run_machine(*config.machine);
  PlantRun run(std::move(config), 0);
  run.run_off_line();
  const RunSummary summary = run.summary("simulate");
  ASSERT_TRUE(summary.machine.has_value());
  EXPECT_EQ(summary.machine->energy.total_J(), alone.energy.total_J());
  EXPECT_EQ(summary.machine->energy.removed_m3, alone.energy.removed_m3);
  EXPECT_EQ(summary.stats->ticks, alone.ticks);
  EXPECT_EQ(summary.verdict.verdict, rt::Verdict::sound) << summary.verdict.reasons.front();
  // one tick behind, as the controller sees the position at its next call
  EXPECT_NEAR(summary.machine->contour_peak_m.value_or(0.0), alone.contour_peak_m, 1e-7);

  const Table rows = parse_csv(read_whole_file(log), log);
  const auto* power = rows.find("power_W");
  ASSERT_NE(power, nullptr);
  ASSERT_EQ(power->values.size(), alone.ticks);
  double joules = 0.0;
  for (const double watts : power->values) joules += watts * 1e-3;
  EXPECT_NEAR(joules / alone.energy.total_J(), 1.0, 1e-6);
  EXPECT_EQ(summary.files.size(), 3U) << "the machine and both axes";
  for (const auto& file : summary.files) std::filesystem::remove(file);
}

TEST(ProgramPort, ItsTickDoesNotAllocate) {
  const auto config = read_server_config({.path = example, .with_ports = false});
  ProgramPort port(*config.machine);
  std::array<io::AxisReport, 2> reports{};
  std::array<io::AxisRequest, 2> requests{};
  io::MachineRequest machine;
  const test::AllocationGuard guard;
  for (std::uint64_t tick = 0; tick < port.ticks() + 100; ++tick) {
    port.send({.tick = tick, .missed_ticks = 0, .start_ns = 0}, reports);
    port.receive(requests);
    port.receive_machine(machine);
  }
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(ProgramPort, AWrongProgramIsRefusedBeforeAnythingRuns) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto program = (folder / "feedtwin_wrong.ngc").string(), machine = (folder / "feedtwin_wrong.toml").string();
  write_whole_file(program, "G21\nG1 X10 F100\nG12 X3\n");
  write_whole_file(machine, "program = \"feedtwin_wrong.ngc\"\n");
  try {
    PlantRun run(read_server_config({.path = machine, .with_ports = false}), 0);
    ADD_FAILURE() << "a program with G12 was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("feedtwin_wrong.ngc:3:1"), std::string::npos) << error.what();
  }
  std::filesystem::remove(program);
  std::filesystem::remove(machine);
}

}  // namespace
}  // namespace feedtwin::tools
