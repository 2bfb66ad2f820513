// Axis ticks a second of the batch simulator on one core, with every instruction set that this processor has: closed-loop
// simulation of an 8 s record with reversals, at one count, each lane another axis. `torque` is the command alone, which is
// what identification asks for first; `all` the sensors and the power too. `off` beside each is the largest difference of
// the command from the server's own axis, over the largest command.

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/made_case.h"
#include "tests/support/random_axis.h"
#include "tools/identify/closed_loop.h"

namespace feedtwin::bench {
namespace {

using namespace feedtwin::tools;

const Recording& record() {
  static const Recording made =
      tests::make_recording(plant::source_axis(), {.motion = "sine",
                                                   .settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.03},
                                                   .duration_s = 8.0,
                                                   .resolution = plant::one_count});
  return made;
}

/// As a Jacobian's columns are: all near one axis. @param spread factor of each number
std::vector<plant::AxisParameters> axes(std::size_t count, double spread) {
  std::mt19937_64 random(3);
  std::vector<plant::AxisParameters> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(tests::axis_near_source(random, spread));
  return all;
}

void simulate(benchmark::State& state, const lanes::KernelEntry& kernel, bool everything, double spread) {
  const ClosedLoopRun run(record(), plant::source_axis(), std::nullopt);
  const auto all = axes(kernel.width, spread);
  std::vector<lanes::Candidate> candidates;
  for (const auto& axis : all) {
    const auto& m = axis.motor;
    candidates.push_back({plant::make_axis_model(without_stops(axis)), m.electrical_idle_W, m.electrical_linear_Ws_per_m.pos,
                          m.electrical_linear_Ws_per_m.neg, m.electrical_quadratic_Ws2_per_m2.pos,
                          m.electrical_quadratic_Ws2_per_m2.neg, 0.0, 0.0, 0.0});
  }
  const std::size_t n = record().size();
  std::vector<double> torque(n * kernel.width), position(torque), sensor(torque), force(torque), power(torque);
  lanes::Outputs out{kernel.width, torque.data(), nullptr, nullptr, nullptr, nullptr};
  if (everything) out = {kernel.width, torque.data(), position.data(), sensor.data(), force.data(), power.data()};
  for (auto _ : state) {
    kernel.run(run.view(), candidates.data(), out);
    benchmark::DoNotOptimize(torque.data());
  }
  double off = 0.0, largest = 0.0;
  for (std::size_t lane = 0; lane < kernel.width; ++lane) {
    plant::FeedAxis axis(without_stops(all[lane]));
    const auto alone = simulate_closed_loop(run, axis);
    for (std::size_t i = 0; i < n; ++i) {
      off = std::max(off, std::abs(torque[i * kernel.width + lane] - alone.torque_Nm[i]));
      largest = std::max(largest, std::abs(alone.torque_Nm[i]));
    }
  }
  const double ticks = static_cast<double>(state.iterations()) * static_cast<double>(n * kernel.width);
  state.counters["ticks"] = benchmark::Counter(ticks, benchmark::Counter::kIsRate);
  state.counters["off"] = off / largest;
}

void register_all() {
  for (const auto& kernel : lanes::usable_kernels()) {
    for (const bool everything : {false, true}) {
      for (const double spread : {1.001, 1.3}) {
        const std::string name = std::string(kernel.instructions) + (everything ? "/all" : "/torque") +
                                 (spread < 1.1 ? "/jacobian" : "/population");
        benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
          simulate(state, kernel, everything, spread);
        })->Unit(benchmark::kMillisecond);
      }
    }
  }
}

}  // namespace
}  // namespace feedtwin::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  feedtwin::bench::register_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
