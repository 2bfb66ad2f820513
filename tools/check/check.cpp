// feedtwin check: is this host fit for real time, and what to change.

#include "tools/check/check.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/check/findings.h"
#include "tools/json_option.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

const char* name_of(Fitness fitness) {
  switch (fitness) {
    case Fitness::fit:
      return "fit";
    case Fitness::improvable:
      return "improvable";
    case Fitness::unfit:
      break;
  }
  return "unfit";
}

const char* mark_of(Fitness fitness) {
  return fitness == Fitness::fit ? "ok  " : fitness == Fitness::improvable ? "note" : "NO  ";
}

nlohmann::json to_json(const std::vector<Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& f : findings)
    list.push_back({{"what", f.what}, {"found", f.found}, {"fitness", name_of(f.fitness)}, {"change", f.change}});
  return {{"verb", "check"}, {"fit", fit_for_real_time(findings)}, {"findings", list}};
}

int run(const std::string& json) {
  const auto findings = findings_on(read_host_facts());
  for (const auto& f : findings)
    fmt::print("{}  {:18}  {}{}{}\n", mark_of(f.fitness), f.what, f.found, f.change.empty() ? "" : "; ", f.change);
  const bool fit = fit_for_real_time(findings);
  fmt::print("\n{}\n", fit ? "This host is fit for real time."
                           : "This host is not fit for real time: runs work and will say \"not-valid-for-latency\".");
  write_json(json, to_json(findings));
  return fit ? done : not_so;
}

}  // namespace

std::function<int()> prepare_check(CLI::App& app) {
  auto json = std::make_shared<std::string>();
  add_json_option(app, *json);
  return [json] { return run(*json); };
}

}  // namespace feedtwin::tools
