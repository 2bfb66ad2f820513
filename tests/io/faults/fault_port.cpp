#include "io/faults/fault_port.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace feedtwin::io::faults {
namespace {

/// A scripted port: a new command every tick, sequence = tick; remembers what it was sent.
class Script final : public Port {
 public:
  explicit Script(bool own_lines) : own_lines_(own_lines) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "script"; }
  void open() override {}
  void close() noexcept override {}
  std::uint64_t receive(std::span<AxisRequest> newest) noexcept FEEDTWIN_REALTIME override {
    if (silent) return 0;
    for (auto& request : newest) request = {.torque_Nm = 0.5, .sequence = ++sequence, .enable = true};
    return (std::uint64_t{1} << newest.size()) - 1;
  }
  void send(const TickReport& /*tick*/, std::span<const AxisReport> axes) noexcept FEEDTWIN_REALTIME override {
    for (std::size_t i = 0; i < axes.size() && i < 2; ++i) sent[i] = axes[i];
  }
  bool break_encoder(EncoderFault fault, int axis, bool on, std::int64_t amount) noexcept FEEDTWIN_REALTIME override {
    broken = static_cast<int>(fault);
    broken_axis = axis;
    broken_on = on;
    broken_amount = amount;
    return own_lines_;
  }
  bool silent = false;
  std::uint32_t sequence = 0;
  std::array<AxisReport, 2> sent{};
  int broken = -1, broken_axis = -1;
  bool broken_on = false;
  std::int64_t broken_amount = 0;

 private:
  bool own_lines_;
};

struct Faulty {
  explicit Faulty(std::vector<Fault> faults, bool own_lines = false, int axes = 1)
      : script(own_lines),
        port(script, std::move(faults), context_of(axes)),
        requests(static_cast<std::size_t>(axes)),
        reports(static_cast<std::size_t>(axes)) {}
  static PortContext context_of(int axes) {
    PortContext context;
    context.axes = axes;
    return context;
  }
  bool tick(std::int64_t moved = 0) {
    const bool came = port.receive(requests) != 0;
    for (auto& report : reports) {
      report.encoder_counts += moved;
      report.index_passed = true;
    }
    port.send({tick_number++, 0, 0}, reports);
    return came;
  }
  Script script;
  FaultPort port;
  std::vector<AxisRequest> requests;
  std::vector<AxisReport> reports;
  std::uint64_t tick_number = 0;
};

TEST(FaultPort, WithoutFaultsItIsNotThere) {
  Faulty run({});
  for (int i = 1; i <= 100; ++i) {
    ASSERT_TRUE(run.tick(3));
    ASSERT_EQ(run.requests[0].sequence, static_cast<std::uint32_t>(i));
    ASSERT_EQ(run.script.sent[0].encoder_counts, 3 * i);
    ASSERT_TRUE(run.script.sent[0].index_passed);
  }
  EXPECT_TRUE(run.port.take_events().empty());
}

TEST(FaultPort, CommandsAreLostInTheirTimeOnly) {
  Faulty run({{.kind = FaultKind::lost_command, .at_s = 0.010, .for_s = 0.020}});
  for (int i = 0; i < 50; ++i) EXPECT_EQ(run.tick(), i < 10 || i >= 30) << i;
}

TEST(FaultPort, AShareOfThemIsLost) {
  Faulty run({{.kind = FaultKind::lost_command, .at_s = 0.0, .for_s = 100.0, .share = 0.3}});
  int lost = 0;
  for (int i = 0; i < 10000; ++i) lost += run.tick() ? 0 : 1;
  EXPECT_NEAR(lost, 3000, 5 * std::sqrt(10000 * 0.3 * 0.7));
}

TEST(FaultPort, LateCommandsComeLateAndInOrder) {
  Faulty run({{.kind = FaultKind::late_command, .at_s = 0.010, .for_s = 0.020, .delay_s = 0.005}});
  std::uint32_t before = 0;
  for (int i = 0; i < 50; ++i) {
    const bool came = run.tick();
    const auto sequence = run.requests[0].sequence;
    if (i < 10 || i >= 35) {
      EXPECT_EQ(sequence, static_cast<std::uint32_t>(i + 1));
    }
    if (i >= 10 && i < 15) {
      EXPECT_FALSE(came) << i;
    }
    if (i >= 15 && i < 30) {
      EXPECT_EQ(sequence, static_cast<std::uint32_t>(i + 1 - 5));
    }
    if (i < 30) {
      EXPECT_GE(sequence, before);
    }
    before = sequence;
  }
}

TEST(FaultPort, RepeatedCommandsComeAgain) {
  Faulty run({{.kind = FaultKind::repeated_command, .at_s = 0.010, .for_s = 0.010}});
  for (int i = 0; i < 10; ++i) run.tick();
  run.script.silent = true;
  for (int i = 10; i < 30; ++i) {
    EXPECT_EQ(run.tick(), i < 20) << i;
    EXPECT_EQ(run.requests[0].sequence, 10U);
  }
}

TEST(FaultPort, CorruptedCommandsHaveOneBitTurned) {
  Faulty run({{.kind = FaultKind::corrupted_command, .at_s = 0.0, .for_s = 100.0}});
  std::set<std::uint32_t> turned;
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(run.tick());
    const auto bits =
        std::bit_cast<std::uint32_t>(static_cast<float>(run.requests[0].torque_Nm)) ^ std::bit_cast<std::uint32_t>(0.5F);
    ASSERT_EQ(std::popcount(bits), 1);
    turned.insert(bits);
  }
  EXPECT_EQ(turned.size(), 32U);  // the exponent's too: huge, tiny and non-numbers
}

TEST(FaultPort, EncoderFaultsShowAsACounterWouldShowThem) {
  {
    Faulty run({{.kind = FaultKind::lost_counts, .at_s = 0.010, .counts = 40}});
    for (int i = 0; i < 20; ++i) run.tick(7);
    EXPECT_EQ(run.script.sent[0].encoder_counts, 20 * 7 - 40);
  }
  {
    Faulty run({{.kind = FaultKind::swapped_ab, .at_s = 0.010, .for_s = 0.005}});
    for (int i = 0; i < 20; ++i) run.tick(7);
    EXPECT_EQ(run.script.sent[0].encoder_counts, (20 - 2 * 5) * 7);
  }
  for (const auto kind : {FaultKind::dead_a, FaultKind::dead_b}) {
    Faulty run({{.kind = kind, .at_s = 0.010, .for_s = 0.005}});
    std::int64_t lowest = 1'000'000, highest = 0;
    for (int i = 0; i < 20; ++i) {
      run.tick(7);
      if (i < 10 || i >= 15) continue;
      lowest = std::min(lowest, run.script.sent[0].encoder_counts);
      highest = std::max(highest, run.script.sent[0].encoder_counts);
    }
    EXPECT_GE(lowest, 70);
    EXPECT_LE(highest, 71);
    EXPECT_NEAR(static_cast<double>(run.script.sent[0].encoder_counts), 15 * 7, 1);  // five ticks' motion is gone for good
  }
  for (const auto kind : {FaultKind::missing_index, FaultKind::dead_index}) {
    Faulty run({{.kind = kind, .at_s = 0.010, .for_s = 0.005}});
    for (int i = 0; i < 20; ++i) {
      run.tick(7);
      EXPECT_EQ(run.script.sent[0].index_passed, i < 10 || i >= 15);
    }
    EXPECT_EQ(run.script.sent[0].encoder_counts, 140);
  }
}

TEST(FaultPort, APortWithLinesOfItsOwnBreaksThoseInstead) {
  Faulty run({{.kind = FaultKind::swapped_ab, .at_s = 0.010, .for_s = 0.005}}, true);
  for (int i = 0; i < 12; ++i) run.tick(7);
  EXPECT_EQ(run.script.broken, static_cast<int>(EncoderFault::swapped_ab));
  EXPECT_TRUE(run.script.broken_on);
  EXPECT_EQ(run.script.sent[0].encoder_counts, 12 * 7);
  for (int i = 0; i < 10; ++i) run.tick(7);
  EXPECT_FALSE(run.script.broken_on);
}

TEST(FaultPort, OneAxisCanBeMeantAlone) {
  Faulty run({{.kind = FaultKind::swapped_ab, .at_s = 0.0, .for_s = 1.0, .axis = 1}}, false, 2);
  for (int i = 0; i < 10; ++i) run.tick(7);
  EXPECT_EQ(run.script.sent[0].encoder_counts, 70);
  EXPECT_EQ(run.script.sent[1].encoder_counts, -70);
}

TEST(FaultPort, SaysWhatHappensWhenItHappens) {
  Faulty run({{.kind = FaultKind::lost_command, .at_s = 0.010, .for_s = 0.005},
              {.kind = FaultKind::lost_counts, .at_s = 0.012, .counts = 3}});
  for (int i = 0; i < 12; ++i) run.tick();
  auto events = run.port.take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_DOUBLE_EQ(events[0].time_s, 0.010);
  EXPECT_EQ(events[0].text, "fault on purpose: lost_command (commands don't arrive)");
  for (int i = 0; i < 12; ++i) run.tick();
  events = run.port.take_events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_DOUBLE_EQ(events[1].time_s, 0.015);
  EXPECT_EQ(events[1].text, "fault on purpose: lost_command ends");
}

}  // namespace
}  // namespace feedtwin::io::faults
