#include "tools/diagnose.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/config/axis_file.h"
#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/diagnosis_json.h"
#include "tools/json_option.h"
#include "tools/recording/case.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct Options {
  std::string folder, json, axis;
};

void print(const diagnosis::Diagnosis& found) {
  fmt::print("{}: {}\n", found.verdict, found.summary);
  for (const auto& effect : found.effects) fmt::print("  {}\n    {}\n", effect.hypothesis->id, effect.sentence);
  for (const auto& [channel, f] : found.holdout)
    fmt::print("  held out {}: nrmse {:.4f} before, {:.4f} recalibrated, {:.4f} after, {:.4f} noise\n", channel, f.before,
               f.recalibrated, f.after, f.floor);
}

int run(const Options& options) {
  const Case data = read_case(options.folder);
  const auto found = diagnosis::diagnose(data, [](std::string_view what) { fmt::print(stderr, "diagnose: {}\n", what); });
  std::string axis_file = options.axis;
  if (axis_file.empty() && !options.json.empty())
    axis_file = (std::filesystem::absolute(options.json).parent_path() / "axis.updated.toml").string();
  if (!axis_file.empty()) write_axis_file(axis_file, found.updated);
  print(found);
  write_json(options.json, diagnosis::to_json(found, axis_file));
  return done;
}

}  // namespace

std::function<int()> prepare_diagnose(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("CASE", options->folder, "folder of the case, or its case.toml")->required();
  add_json_option(app, options->json);
  app.add_option("--axis", options->axis, "write the updated axis here; by default axis.updated.toml beside the JSON")
      ->type_name("FILE");
  return [options] { return run(*options); };
}

}  // namespace feedtwin::tools
