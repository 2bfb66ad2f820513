// feedtwin latency: wake-up, tick and input age of this host, beside what cyclictest measures in the same minute.

#include "tools/latency/latency.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/udp/udp_port.h"
#include "tools/config/input_error.h"
#include "tools/json_option.h"
#include "tools/latency/cyclictest.h"
#include "tools/latency/udp_probe.h"
#include "tools/median.h"
#include "tools/run/plant_run.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct LatencyOptions {
  std::string config, json;
  double duration_s = 10.0;
  int pairs = 1;
  std::optional<int> cpu, priority;
};

constexpr std::array shares{std::pair{"p50", 0.5}, std::pair{"p99", 0.99}, std::pair{"p99_9", 0.999}};

struct Pair {
  std::array<double, shares.size()> ours_us{}, cyclictest_us{};
};

ServerConfig configure(const LatencyOptions& options) {
  ServerConfig config = read_server_config({.path = options.config, .controller = "loopback", .with_ports = false});
  config.log_path.clear();
  if (options.cpu) config.real_time.cpu = *options.cpu;
  if (options.priority) config.real_time.priority = *options.priority;
  return config;
}

/// The wake-up histogram as a picture: one line an octave, the bar on a logarithmic scale.
void draw(const rt::LatencyHistogram& histogram) {
  std::array<std::uint64_t, 32> octaves{};
  histogram.each([&](double edge_us, std::uint64_t count) {
    octaves[static_cast<std::size_t>(std::clamp(std::ceil(std::log2(std::max(edge_us, 1.0))), 0.0, 31.0))] += count;
  });
  const auto first = std::ranges::find_if(octaves, [](auto count) { return count > 0; });
  const auto last = std::find_if(octaves.rbegin(), octaves.rend(), [](auto count) { return count > 0; }).base();
  fmt::print("\nWake-up, us\n");
  for (auto it = first; it < last; ++it) {
    const auto width = *it == 0 ? 0 : 1 + static_cast<int>(8.0 * std::log10(static_cast<double>(*it)));
    fmt::print("  to {:>7.0f} {:>9} {}\n", std::exp2(it - octaves.begin()), *it,
               std::string(static_cast<std::size_t>(width), '#'));
  }
}

/// A run of its own, commanded over UDP: the probe would disturb the comparison with cyclictest.
nlohmann::json measure_input_to_output(const LatencyOptions& options) {
  ServerConfig config = configure(options);
  config.axes.resize(1);
  config.controller = "udp";
  auto port = std::make_unique<io::udp::UdpPort>(io::udp::UdpSettings{.port = 0}, config.context());
  const io::udp::UdpPort& udp = *port;
  config.ports.push_back({"udp", std::move(port)});
  const double tick_s = config.loop.tick_s;
  const rt::RtSettings settings = config.real_time;
  PlantRun plant(std::move(config), static_cast<std::uint64_t>(std::llround(std::min(options.duration_s, 5.0) / tick_s)));
  std::atomic<bool> stop{false};
  UdpProbe probe(udp.udp_port(), tick_s, settings);
  fmt::print(stderr, "input to output over UDP\n");
  plant.run_in_real_time(stop);
  probe.stop();
  const auto& histogram = probe.input_to_output();
  fmt::print(
      "\nInput to output over UDP, at a random phase of the tick: p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us, {} exchanges",
      histogram.percentile_us(0.5), histogram.percentile_us(0.99), histogram.percentile_us(1.0), histogram.total());
  fmt::print("{}\n", probe.unanswered() > 0 ? fmt::format(", {} unanswered", probe.unanswered()) : "");
  return {{"p50", histogram.percentile_us(0.5)},     {"p99", histogram.percentile_us(0.99)},
          {"p99_9", histogram.percentile_us(0.999)}, {"max", histogram.percentile_us(1.0)},
          {"exchanges", histogram.total()},          {"unanswered", probe.unanswered()}};
}

nlohmann::json compare(const std::vector<Pair>& pairs) {
  nlohmann::json out;
  fmt::print("\nBeside cyclictest, same core, priority and period; median of {} pairs\n", pairs.size());
  fmt::print("           feedtwin us  cyclictest us     ratio\n");
  for (std::size_t i = 0; i < shares.size(); ++i) {
    std::vector<double> ours, theirs, ratios;
    for (const auto& pair : pairs) {
      ours.push_back(pair.ours_us[i]);
      theirs.push_back(pair.cyclictest_us[i]);
      ratios.push_back(pair.ours_us[i] / pair.cyclictest_us[i]);
    }
    const double ratio = median_of(ratios);
    fmt::print("  {:<6} {:>13.1f} {:>14.1f} {:>9.2f}\n", shares[i].first, median_of(ours), median_of(theirs), ratio);
    out[shares[i].first] = {{"feedtwin_us", ours}, {"cyclictest_us", theirs}, {"median_ratio", ratio}};
  }
  return out;
}

int run_latency(const LatencyOptions& options) {
  const bool yardstick = cyclictest_is_installed();
  if (!yardstick) fmt::print(stderr, "cyclictest is not installed (Debian: rt-tests); measuring without the yardstick\n");
  std::vector<Pair> pairs;
  nlohmann::json json;
  for (int i = 0; i < options.pairs; ++i) {
    ServerConfig config = configure(options);
    const CyclictestSettings same{config.real_time.priority, config.real_time.cpu, options.duration_s, config.loop.tick_s};
    const auto ticks = static_cast<std::uint64_t>(std::llround(options.duration_s / config.loop.tick_s));
    PlantRun plant(std::move(config), ticks);
    std::atomic<bool> stop{false};
    fmt::print(stderr, "pair {} of {}: feedtwin\n", i + 1, options.pairs);
    plant.run_in_real_time(stop);
    const RunSummary summary = plant.summary("latency");
    if (i + 1 == options.pairs) {
      print(summary);
      draw(summary.stats->wakeup);
      json = to_json(summary);
    }
    if (!yardstick) continue;
    fmt::print(stderr, "pair {} of {}: cyclictest\n", i + 1, options.pairs);
    const auto theirs = run_cyclictest(same);
    if (!theirs) throw InputError("cyclictest could not be run with these settings (priority needs the right to it)");
    Pair pair;
    for (std::size_t s = 0; s < shares.size(); ++s) {
      pair.ours_us[s] = summary.stats->wakeup.percentile_us(shares[s].second);
      pair.cyclictest_us[s] = theirs->percentile_us(shares[s].second);
    }
    pairs.push_back(pair);
  }
  if (!pairs.empty()) json["cyclictest"] = compare(pairs);
  json["input_to_output_us"] = measure_input_to_output(options);
  write_json(options.json, json);
  return json["verdict"] == "unsound" ? not_so : done;
}

}  // namespace

std::function<int()> prepare_latency(CLI::App& app) {
  auto options = std::make_shared<LatencyOptions>();
  app.add_option("CONFIG", options->config, "server configuration or axis file (TOML); without it, the source's axis");
  app.add_option("--duration", options->duration_s, "length of each run in s")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.add_option("--pairs", options->pairs, "runs beside cyclictest, in turn")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--cpu", options->cpu, "core for the tick and for cyclictest");
  app.add_option("--priority", options->priority, "SCHED_FIFO priority of both")->check(CLI::Range(1, 98));
  add_json_option(app, options->json);
  return [options] { return run_latency(*options); };
}

}  // namespace feedtwin::tools
