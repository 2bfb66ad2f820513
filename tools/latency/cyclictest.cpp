#include "tools/latency/cyclictest.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace feedtwin::tools {
namespace {

constexpr const char* program = "/usr/bin/cyclictest";

}  // namespace

bool cyclictest_is_installed() {
  return ::access(program, X_OK) == 0;
}

double CyclictestResult::percentile_us(double share) const {
  const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(total));
  std::uint64_t seen = 0;
  for (const auto& [latency_us, count] : histogram) {
    seen += count;
    if (seen >= wanted) return latency_us + 0.5;  // cyclictest cuts off the fraction of a us
  }
  return 0.0;
}

std::optional<CyclictestResult> run_cyclictest(const CyclictestSettings& settings) {
  const auto answer = std::filesystem::temp_directory_path() / fmt::format("feedtwin-cyclictest-{}.json", ::getpid());
  const std::string command = fmt::format(
      "{} --mlockall --priority={} --interval={:.0f} --duration={:.0f} --histogram=100000 --quiet {} --threads=1 "
      "--json={} >/dev/null 2>&1",
      program, settings.priority, settings.period_s * 1e6, settings.duration_s,
      settings.cpu >= 0 ? fmt::format("--affinity={}", settings.cpu) : "", answer.string());
  if (std::system(command.c_str()) != 0) return std::nullopt;  // NOLINT(bugprone-command-processor): our own words alone
  CyclictestResult result;
  try {
    std::ifstream file(answer);
    const auto json = nlohmann::json::parse(file);
    for (const auto& [latency_us, count] : json.at("thread").at("0").at("histogram").items()) {
      result.histogram[std::stoi(latency_us)] += count.get<std::uint64_t>();
      result.total += count.get<std::uint64_t>();
    }
  } catch (const std::exception&) {
    return std::nullopt;
  }
  std::filesystem::remove(answer);
  return result;
}

}  // namespace feedtwin::tools
