#include "rt/machine_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/parameter_table.h"
#include "rt/plant_loop.h"
#include "tests/support/allocation_guard.h"

namespace feedtwin::rt {
namespace {

plant::MachineParameters parameters() {
  plant::MachineParameters machine;
  machine.x = machine.y = plant::source_axis();
  machine.spindle = plant::spindle_motor_A();
  machine.cutting = {.Ktc_N_per_m2 = 160e6, .Krc_N_per_m2 = 50e6, .Kte_N_per_m = 1100.0, .Kre_N_per_m = 1000.0};
  return machine;
}

constexpr plant::BlockParameters wide_block{-1.0, 1.0, -1.0, 1.0, 0.0};

/// Random torques, spindle speeds, M-codes and engagements, the same for the same seed.
class MachinePort final : public io::Port {
 public:
  explicit MachinePort(unsigned seed) : random_(seed) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "scripted"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<io::AxisRequest> newest) noexcept FEEDTWIN_REALTIME override {
    if (silent) return 0;
    for (std::size_t i = 0; i < 2; ++i) {
      newest[i].torque_Nm = torques_Nm[i];
      newest[i].sequence = sequence_;
      newest[i].arrival_ns = now_ns_;
      newest[i].enable = true;
    }
    return 0b11;
  }
  bool receive_machine(io::MachineRequest& newest) noexcept FEEDTWIN_REALTIME override {
    if (silent) return false;
    newest = machine;
    return true;
  }
  void send(const io::TickReport& tick, std::span<const io::AxisReport>) noexcept FEEDTWIN_REALTIME override {
    now_ns_ = tick.start_ns;
    ++sequence_;
    if (random) draw();
  }
  void draw() noexcept {
    const auto uniform = [this](double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); };
    for (double& torque : torques_Nm) torque = uniform(-0.5, 0.5);
    machine.spindle_speed_rad_per_s = uniform(-400.0, 400.0);
    machine.pump = uniform(0.0, 1.0) < 0.5;
    machine.path_engagement = true;
    machine.engagement =
        uniform(0.0, 1.0) < 0.5 ? plant::slot(uniform(1e-4, 1e-3), uniform(-3.0, 3.0)) : plant::Engagement{};
  }
  bool silent = false, random = true;
  std::array<double, 2> torques_Nm{};
  io::MachineRequest machine;

 private:
  std::mt19937 random_;
  std::uint32_t sequence_ = 0;
  std::int64_t now_ns_ = 0;
};

struct MachineBench {
  explicit MachineBench(unsigned seed, std::size_t rows = 1024, const plant::BlockParameters& block = wide_block)
      : plant(parameters(), block, rows), port(seed) {
    loop =
        std::make_unique<PlantLoop>(plant, port, std::vector<io::Port*>{}, clock, LoopSettings{.watchdog_ns = 20'000'000});
  }
  void run(std::uint64_t ticks) { loop->run_to(loop->stats().ticks + ticks, stop); }
  MachinePlant plant;
  MachinePort port;
  OfflineClock clock{1'000'000};
  std::atomic<bool> stop{false};
  std::unique_ptr<PlantLoop> loop;
};

TEST(MachinePlant, UnderTheLoopIsTheMachineByItself) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    MachineBench bench(seed);
    MachinePort same(seed);
    plant::Machine twin(parameters());
    same.draw();
    for (int tick = 0; tick < 2000; ++tick) {
      twin.step({same.torques_Nm[0], same.torques_Nm[1], same.machine.spindle_speed_rad_per_s, same.machine.pump,
                 same.machine.engagement},
                1e-3);
      same.draw();
    }
    bench.run(2000);
    const auto a = bench.plant.machine().energy(), b = twin.energy();
    EXPECT_EQ(a.total_J(), b.total_J());
    EXPECT_EQ(a.pump_J, b.pump_J);
    EXPECT_EQ(a.removed_m3, b.removed_m3);
    EXPECT_GT(a.removed_m3, 0.0);
    EXPECT_EQ(bench.plant.axis(1).state().position_m, twin.y().state().position_m);
  }
}

TEST(MachinePlant, TheTickDoesNotAllocateAndCountsRowsThatFindNoRoom) {
  MachineBench bench(3, 512);
  bench.run(10);
  std::uint64_t allocations = 0;
  {
    const test::AllocationGuard guard;
    bench.run(3000);
    allocations = guard.allocations();
  }
  EXPECT_EQ(allocations, 0U);
  EXPECT_EQ(bench.plant.dropped_records(), 3010U - 512U);
}

TEST(MachinePlant, RowsHoldTheEnergyOfTheirTicks) {
  MachineBench bench(4, 4096);
  bench.run(2000);
  std::vector<MachineRecord> rows(4096);
  ASSERT_EQ(bench.plant.records().pop(rows), 2000U);
  double joules = 0.0;
  for (std::size_t i = 0; i < 2000; ++i) {
    const auto& r = rows[i];
    joules += r.power.total_W() * 1e-3;
    EXPECT_NEAR(r.time_s, 1e-3 * static_cast<double>(i + 1), 1e-9);
  }
  EXPECT_NEAR(joules / bench.plant.machine().energy().total_J(), 1.0, 1e-9);
}

TEST(MachinePlant, ASilentControllerLosesSpindleAndPumpWithItsTorque) {
  MachineBench bench(5);
  bench.port.random = false;
  bench.port.machine = {.spindle_speed_rad_per_s = 200.0, .pump = true};
  bench.run(2000);
  EXPECT_NEAR(bench.plant.machine().signals().spindle_speed_rad_per_s, 200.0, 1.0);
  EXPECT_TRUE(bench.plant.machine().signals().pump_on);
  bench.port.silent = true;
  bench.run(22);
  EXPECT_FALSE(bench.plant.machine().signals().pump_on);
  bench.run(2000);
  EXPECT_NEAR(bench.plant.machine().signals().spindle_speed_rad_per_s, 0.0, 1.0);
}

TEST(MachinePlant, DepthOfCutActsOverTheBlockOnly) {
  const auto removed = [](const plant::BlockParameters& block) {
    MachineBench bench(6, 16, block);
    bench.port.random = false;
    bench.port.torques_Nm = {0.5, 0.3};
    bench.port.machine = {.spindle_speed_rad_per_s = 300.0, .depth_of_cut_m = 1e-4};
    bench.run(300);
    return bench.plant.machine().energy().removed_m3;
  };
  EXPECT_GT(removed(wide_block), 0.0);
  EXPECT_EQ(removed({0.5, 0.6, 0.5, 0.6, 0.0}), 0.0);
}

}  // namespace
}  // namespace feedtwin::rt
