// What a tick costs with each effect alone and with all of them, ns; the best of several rounds, to leave out what else the
// processor does. The command swings the axis at up to 0.1 m/s through reversals.
//
//   build/release/bench_effects [TICKS]

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tests/support/typical_effects.h"

namespace {

using namespace feedtwin::plant;
using Clock = std::chrono::steady_clock;

struct Cost {
  double mean_ns, worst_ns;  ///< a tick: mean of the best round, and the worst hundred in a row of it
};

Cost cost_of(const std::vector<EffectSetting>& effects, int ticks) {
  constexpr int rounds = 5, together = 100;
  Cost best{1e9, 1e9};
  for (int round = 0; round < rounds; ++round) {
    AxisParameters parameters = source_axis();
    parameters.effects = effects;
    FeedAxis axis(parameters);
    double sum_ns = 0.0, worst_ns = 0.0;
    for (int i = 0; i < ticks; i += together) {
      const auto begin = Clock::now();
      for (int j = i; j < i + together; ++j) axis.step({0.35 * std::sin(0.012 * j) + 0.02 * std::sin(0.31 * j)}, 1e-3);
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
      sum_ns += ns;
      worst_ns = std::max(worst_ns, ns / together);
    }
    if (sum_ns / ticks < best.mean_ns) best = {sum_ns / ticks, worst_ns};
  }
  return best;
}

void print(std::string_view name, const Cost& cost, const Cost& without) {
  fmt::print("{:32} {:8.0f} {:8.0f} {:+8.0f}\n", name, cost.mean_ns, cost.worst_ns, cost.mean_ns - without.mean_ns);
}

}  // namespace

int main(int argc, char** argv) {
  const int ticks = argc > 1 ? std::atoi(argv[1]) : 5000;
  const Cost without = cost_of({}, ticks);
  fmt::print("{:32} {:>8} {:>8} {:>8}\n", "ns a tick", "mean", "worst", "more");
  print("no effect", without, without);
  std::vector<EffectSetting> all;
  for (const auto& entry : effect_registry()) {
    const auto setting = feedtwin::test::typical_effect(entry);
    print(entry.id, cost_of({setting}, ticks), without);
    all.push_back(setting);
  }
  print("all together", cost_of(all, ticks), without);
}
