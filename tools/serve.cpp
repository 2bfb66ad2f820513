// feedtwin serve: the real-time plant server.

#include "tools/serve.h"

#include <cmath>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/json_option.h"
#include "tools/run/plant_run.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct ServeOptions {
  std::string config, controller, log, json;
  double duration_s = 0.0;
};

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void request_stop(int) {
  stop_requested.store(true);
}

int run_serve(const ServeOptions& options) {
  ConfigRequest request;
  request.path = options.config;
  if (!options.controller.empty()) request.controller = options.controller;
  ServerConfig config = read_server_config(request);
  if (!options.log.empty()) config.log_path = options.log;
  const auto ticks = static_cast<std::uint64_t>(std::llround(options.duration_s / config.loop.tick_s));

  PlantRun plant(std::move(config), ticks);
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  plant.run_in_real_time(stop_requested);
  const RunSummary summary = plant.summary("serve");
  print(summary);
  write_json(options.json, to_json(summary));
  return summary.verdict.verdict == rt::Verdict::unsound ? not_so : done;
}

}  // namespace

std::function<int()> prepare_serve(CLI::App& app) {
  auto options = std::make_shared<ServeOptions>();
  app.add_option("CONFIG", options->config,
                 "server configuration, axis or machine file (TOML); without it, the source's axis");
  app.add_option("--duration", options->duration_s,
                 "run time in s; 0: until interrupted, or to the end of a machine's program")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--controller", options->controller,
                 "who commands: loopback, modbus, can, udp or a port's name; program, for a machine file");
  app.add_option("--log", options->log, "recording of every tick (CSV), with its events beside it")->type_name("FILE");
  add_json_option(app, options->json);
  return [options] { return run_serve(*options); };
}

}  // namespace feedtwin::tools
