// What a tick costs, against general integrators on the same work: the torques of ten seconds of closed-loop motion with
// reversals, creep, dwell in pre-sliding and speeds to 0.26 m/s (tests/golden/golden_motion.h), energy included. The error
// beside each is the largest in the same closed loop against CVODE at 1e-10, in encoder counts of 76.3 nm.

#include "plant/feed_axis.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plant/parameter_table.h"
#include "tests/bench/methods/other_methods.h"
#include "tests/golden/cvode_axis.h"
#include "tests/golden/golden_motion.h"
#include "tests/golden/runge_kutta_axis.h"

namespace feedtwin::bench {
namespace {

using golden::golden_ticks;
using golden::tick_s;

struct Trace {
  std::vector<double> force_N, position_m;
};

const Trace& trace() {
  static const Trace made = [] {
    Trace t;
    golden::CvodeAxis axis{golden::FeedDrive{}};
    golden::GoldenController controller;
    for (int i = 0; i < golden_ticks; ++i) {
      t.force_N.push_back(controller.force_N(i, axis.state()[golden::position]));
      axis.tick(t.force_N.back(), tick_s);
      t.position_m.push_back(axis.state()[golden::position]);
    }
    return t;
  }();
  return made;
}

/// The plant with the interface of the others.
class PlantAxis {
 public:
  explicit PlantAxis(plant::Resolution resolution) : axis_(plant::source_axis(), resolution) {}
  void tick(double force_N, double dt) { axis_.step({.torque_Nm = force_N / axis_.model().transmission_rad_per_m}, dt); }
  [[nodiscard]] golden::State state() const { return {axis_.signals().position_m}; }

 private:
  plant::FeedAxis axis_;
};

template <class Axis>
double closed_loop_error_counts(Axis axis) {
  golden::GoldenController controller;
  double worst_m = 0.0;
  for (int i = 0; i < golden_ticks; ++i) {
    axis.tick(controller.force_N(i, axis.state()[golden::position]), tick_s);
    const double error_m = std::abs(axis.state()[golden::position] - trace().position_m[static_cast<std::size_t>(i)]);
    worst_m = std::isfinite(error_m) ? std::max(worst_m, error_m) : HUGE_VAL;
  }
  return worst_m / test::count_m;
}

template <class Make>
void replay(benchmark::State& state, Make make) {
  const Trace& t = trace();
  for (auto _ : state) {
    auto axis = make();
    for (const double force_N : t.force_N) axis.tick(force_N, tick_s);
    benchmark::DoNotOptimize(axis.state());
  }
  const double ticks = static_cast<double>(state.iterations()) * golden_ticks;
  state.counters["per_tick"] = benchmark::Counter(ticks, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["error_counts"] = closed_loop_error_counts(make());
}

/// The dearest tick: each alone, from its own state, the mean of many repetitions.
void dearest_tick(benchmark::State& state, plant::Resolution resolution, double from_s, double to_s) {
  plant::AxisModel<double> model = plant::make_axis_model(plant::source_axis());
  plant::NoEffects<double> none;
  for (auto _ : state) {
    plant::AxisState<double> y;
    std::vector<double> cost_ns;
    for (int i = 0; i < golden_ticks; ++i) {
      const double force_N = trace().force_N[static_cast<std::size_t>(i)];
      const double t = i * tick_s;
      if (t >= from_s && t < to_s) {
        double best = HUGE_VAL;
        for (int attempt = 0; attempt < 5; ++attempt) {
          constexpr int repetitions = 20;
          const auto start = std::chrono::steady_clock::now();
          for (int r = 0; r < repetitions; ++r) {
            plant::AxisState<double> copy = y;
            auto losses = plant::integrate_tick<double>(model, copy, none, force_N, tick_s, resolution);
            benchmark::DoNotOptimize(losses);
            benchmark::DoNotOptimize(copy);
          }
          best = std::min(best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
                                    repetitions);
        }
        cost_ns.push_back(best);
      }
      plant::integrate_tick<double>(model, y, none, force_N, tick_s, resolution);
    }
    std::ranges::sort(cost_ns);
    state.counters["p50_ns"] = cost_ns[cost_ns.size() / 2];
    state.counters["p99_ns"] = cost_ns[cost_ns.size() * 99 / 100];
    state.counters["dearest_ns"] = cost_ns.back();
  }
}

/// One tick of many axes on one core; each with a motion of its own.
void many_axes(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<plant::FeedAxis> axes;
  axes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) axes.emplace_back(plant::source_axis());
  const Trace& t = trace();
  std::size_t tick = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) {
      const double force_N = t.force_N[(tick + 7 * i) % golden_ticks];
      axes[i].step({.torque_Nm = force_N / axes[i].model().transmission_rad_per_m}, tick_s);
    }
    ++tick;
  }
  state.counters["ms_for_all"] = benchmark::Counter(static_cast<double>(state.iterations()) * 1e-3,
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Ten million ticks: the resident memory must not grow.
void memory(benchmark::State& state) {
  const auto resident_kB = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss);
  };
  plant::FeedAxis axis(plant::source_axis());
  const double before_kB = resident_kB();
  for (auto _ : state) {
    for (std::size_t i = 0; i < 10000000; ++i)
      axis.step({.torque_Nm = trace().force_N[i % golden_ticks] / axis.model().transmission_rad_per_m}, tick_s);
  }
  state.counters["grown_kB"] = resident_kB() - before_kB;
}

/// Prints as usual and keeps what the ratios need.
class Ratios final : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto found = run.counters.find("per_tick");
      if (found != run.counters.end()) seconds_[run.benchmark_name()] = found->second.value;
    }
    ConsoleReporter::ReportRuns(runs);
  }
  void print() const {
    const auto ours = seconds_.find("plant/one_count");
    if (ours == seconds_.end()) return;
    std::printf("\nns a tick, and times the cost of plant/one_count:\n");
    for (const auto& [name, s] : seconds_) std::printf("  %-28s %9.0f %8.1f\n", name.c_str(), 1e9 * s, s / ours->second);
  }

 private:
  std::map<std::string, double> seconds_;
};

void register_all() {
  using benchmark::RegisterBenchmark;
  const auto add = [](const char* name, auto make) {
    RegisterBenchmark(name, [make](benchmark::State& state) { replay(state, make); })->Unit(benchmark::kMillisecond);
  };
  add("plant/one_count", [] { return PlantAxis(plant::one_count); });
  add("plant/tenth_of_a_count", [] { return PlantAxis(plant::tenth_of_a_count); });
  // each general method at the loosest setting that keeps one count; RK4 at the fewest sub-steps that are stable
  add("cvode/3e-7", [] { return golden::CvodeAxis(golden::FeedDrive{}, 3e-7); });
  add("odeint_dopri5/2e-4", [] { return DormandPrinceAxis(2e-4); });
  add("odeint_rosenbrock4/1e-3", [] { return RosenbrockAxis(1e-3); });
  add("rk4/75_substeps", [] { return golden::RungeKuttaAxis(golden::FeedDrive{}, 75); });
  add("euler/150_substeps", [] { return EulerAxis(150); });
  const auto dearest = [](const char* name, plant::Resolution resolution, double from_s, double to_s) {
    RegisterBenchmark(name, [=](benchmark::State& state) { dearest_tick(state, resolution, from_s, to_s); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  };
  dearest("dearest_tick/whole_motion", plant::one_count, 0.0, 10.0);
  dearest("dearest_tick/to_0.26_m_per_s", plant::one_count, 7.0, 10.0);
  dearest("dearest_tick/tenth", plant::tenth_of_a_count, 0.0, 10.0);
  RegisterBenchmark("axes_in_a_tick", many_axes)->Arg(1)->Arg(100)->Arg(6000)->Unit(benchmark::kMicrosecond);
  RegisterBenchmark("memory/ten_million_ticks", memory)->Iterations(1)->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace feedtwin::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  feedtwin::bench::register_all();
  feedtwin::bench::Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  ratios.print();
  return 0;
}
