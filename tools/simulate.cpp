// feedtwin simulate: controller and plant off line.

#include "tools/simulate.h"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tools/json_option.h"
#include "tools/run/plant_run.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

constexpr double default_duration_s = 10.0;

struct SimulateOptions {
  std::string config, log = "simulated.csv", json;
  std::optional<double> duration_s;
};

int run_simulate(const SimulateOptions& options) {
  ServerConfig config = read_server_config({.path = options.config, .with_ports = false, .commanded_inside = true});
  config.log_path = options.log;
  const bool whole_program = config.machine && !options.duration_s;
  const double duration_s = options.duration_s.value_or(default_duration_s);
  const auto ticks = whole_program ? 0 : static_cast<std::uint64_t>(std::llround(duration_s / config.loop.tick_s));
  PlantRun plant(std::move(config), ticks);
  plant.run_off_line();
  const RunSummary summary = plant.summary("simulate");
  print(summary);
  write_json(options.json, to_json(summary));
  return summary.verdict.verdict == rt::Verdict::unsound ? not_so : done;
}

}  // namespace

std::function<int()> prepare_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  app.add_option("CONFIG", options->config,
                 "server configuration, axis or machine file (TOML); without it, the source's axis");
  app.add_option("--duration", options->duration_s, "simulated time in s; without it 10 s, or to a program's end")
      ->check(CLI::Range(1e-3, 1e6));
  app.add_option("--log,--out", options->log, "where the recording goes")->type_name("FILE")->capture_default_str();
  add_json_option(app, options->json);
  return [options] { return run_simulate(*options); };
}

}  // namespace feedtwin::tools
