// How many times faster than real time the whole machine runs on one core: controller, two axes, spindle, cut.
//
//   build/release/bench_machine

#include <fmt/core.h>

#include <algorithm>

#include "tools/machine/machine_run.h"

int main() {
  using namespace feedtwin::tools;
  double best = 0.0;
  for (int i = 0; i < 10; ++i) {
    const auto result = run_machine(source_machine());
    best = std::max(best, result.time_s / result.wall_s);
  }
  fmt::print("machine: {:.0f} times real time (asked for: 200)\n", best);
  return best >= 200.0 ? 0 : 1;
}
