// feedtwin identify: parameters of an axis from recordings; by one process or by as many as mpirun starts.

#include "tools/identify.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tools/config/axis_file.h"
#include "tools/config/input_error.h"
#include "tools/identify/identification.h"
#include "tools/identify/population/shared_columns.h"
#include "tools/identify/stages/stage_report.h"
#include "tools/json_option.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct IdentifyOptions {
  std::string folder, out, json;
  bool force_offset = false;
  std::string method = "staged";
  std::uint64_t seed = 1;
};

/// The case as every process reads it; one that can't be read anywhere is an error everywhere, said once.
std::optional<Case> read_everywhere(const std::string& folder, const Ranks& ranks) {
  std::optional<Case> recordings;
  std::string problem;
  try {
    recordings = read_case(folder);
  } catch (const InputError& error) {
    problem = error.what();
  }
  problem = first_problem(ranks, problem);
  if (problem.empty()) return recordings;
  if (ranks.first()) fmt::print(stderr, "feedtwin: {}\n", problem);
  return std::nullopt;
}

void write_results(const IdentifyOptions& options, const Case& recordings, const Identification& found) {
  fmt::print("{}", to_text(found));
  if (!options.out.empty()) write_axis_file(options.out, found.axis);
  if (options.json.empty()) return;
  nlohmann::json out = to_json(found);
  out["verb"] = "identify";
  out["case"] = options.folder;
  out["remarks"] = recordings.remarks;
  auto figures = figures_of(found.stages, recordings.fit, found.axis);
  for (auto& figure : figures_of(found.after, found.axis)) figures.push_back(std::move(figure));
  out["figures"] = to_json(figures);
  write_json(options.json, out);
}

int run_identify(const IdentifyOptions& options) {
  const Ranks& ranks = Ranks::world();
  lanes::use_no_wider_than(smallest_of(ranks, lanes::best_kernel().width));
  const auto recordings = read_everywhere(options.folder, ranks);
  if (!recordings) return wrong_input;
  IdentificationSettings settings;
  settings.force_offset = options.force_offset;
  settings.method = std::ranges::find(method_names(), options.method, &MethodName::name)->method;
  settings.population.seed = options.seed;
  settings.output_error.ranks = &ranks;
  if (ranks.first()) {
    for (const auto& remark : recordings->remarks) fmt::print(stderr, "feedtwin: {}\n", remark);
    settings.output_error.progress = [](const std::string& line) { fmt::print(stderr, "identify: {}\n", line); };
  }
  const Identification found = identify_case(*recordings, settings);
  if (ranks.first()) write_results(options, *recordings, found);
  return found.fit.converged ? done : not_so;
}

}  // namespace

std::function<int()> prepare_identify(CLI::App& app) {
  auto options = std::make_shared<IdentifyOptions>();
  app.add_option("CASE", options->folder, "folder with case.toml, or the file itself")->required();
  app.add_option("--out", options->out, "write the identified axis to this file")->type_name("FILE");
  app.add_flag("--force-offset", options->force_offset,
               "look for a constant force (gravity) beside direction-dependent friction");
  std::vector<std::string> names;
  std::string meanings = "where the fit of everything together starts from";
  for (const auto& [name, meaning, method] : method_names()) {
    names.emplace_back(name);
    meanings += fmt::format("; {}: {}", name, meaning);
  }
  app.add_option("--method", options->method, meanings)->check(CLI::IsMember(names))->capture_default_str();
  app.add_option("--seed", options->seed, "of the population's draws")->capture_default_str();
  add_json_option(app, options->json);
  return [options] { return run_identify(*options); };
}

}  // namespace feedtwin::tools
