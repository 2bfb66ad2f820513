#include "tools/simulate.h"

#include <fmt/core.h>

#include <memory>
#include <string>

#include "controllers/cascade.h"
#include "controllers/motion.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tools/config/axis_file.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct Options {
  std::string config;
  double duration_s = 10.0;
};

int run(const Options& options) {
  const auto parameters = options.config.empty() ? plant::source_axis() : read_axis_file(options.config);
  plant::FeedAxis axis(parameters);
  controllers::Cascade cascade({});
  const auto motion = controllers::motion_kinds()[1].make({});
  const double tick_s = 1e-3;
  for (int i = 0; i < static_cast<int>(options.duration_s / tick_s); ++i) {
    const auto reference = motion->at(i * tick_s);
    const double position_m = axis.encoder().position_m(axis.signals().encoder_counts);
    axis.step({.torque_Nm = cascade.torque_Nm(reference, position_m, tick_s)}, tick_s);
  }
  const auto e = axis.energy();
  fmt::print("electrical {:.3f} J, motor {:.3f} J, screw {:.3f} J, guide {:.3f} J, balance error {:.2e}\n",
             e.motor_electrical_J, e.motor_mechanical_J, e.ball_screw_J, e.guide_J, e.balance_error());
  return done;
}

}  // namespace

std::function<int()> prepare_simulate(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("CONFIG", options->config, "axis or server configuration (TOML); without it, the source's axis");
  app.add_option("--duration", options->duration_s, "simulated time, s");
  return [options] { return run(*options); };
}

}  // namespace feedtwin::tools
