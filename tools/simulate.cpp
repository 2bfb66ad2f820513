// feedtwin simulate: controller and plant off line.

#include "tools/simulate.h"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/json_option.h"
#include "tools/run/plant_run.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct Options {
  std::string config, log = "simulated.csv", json;
  double duration_s = 10.0;
};

int run(const Options& options) {
  ServerConfig config = read_server_config({.path = options.config, .controller = "loopback", .with_ports = false});
  config.log_path = options.log;
  const auto ticks = static_cast<std::uint64_t>(std::llround(options.duration_s / config.loop.tick_s));
  PlantRun plant(std::move(config), ticks);
  plant.run_off_line();
  const RunSummary summary = plant.summary("simulate");
  print(summary);
  write_json(options.json, to_json(summary));
  return summary.verdict.verdict == rt::Verdict::unsound ? not_so : done;
}

}  // namespace

std::function<int()> prepare_simulate(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("CONFIG", options->config, "server configuration or axis file (TOML); without it, the source's axis");
  app.add_option("--duration", options->duration_s, "simulated time in s")
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str();
  app.add_option("--log,--out", options->log, "where the recording goes")->type_name("FILE")->capture_default_str();
  add_json_option(app, options->json);
  return [options] { return run(*options); };
}

}  // namespace feedtwin::tools
