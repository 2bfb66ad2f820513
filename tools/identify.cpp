// feedtwin identify: parameters of an axis from recordings.

#include "tools/identify.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/config/axis_file.h"
#include "tools/identify/identification.h"
#include "tools/json_option.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct Options {
  std::string folder, out, json;
  bool force_offset = false;
};

int run(const Options& options) {
  const Case recordings = read_case(options.folder);
  for (const auto& remark : recordings.remarks) fmt::print(stderr, "feedtwin: {}\n", remark);
  IdentificationSettings settings;
  settings.force_offset = options.force_offset;
  settings.output_error.progress = [](const std::string& line) { fmt::print(stderr, "identify: {}\n", line); };
  const Identification found = identify_case(recordings, settings);
  fmt::print("{}", to_text(found));
  if (!options.out.empty()) write_axis_file(options.out, found.axis);
  if (!options.json.empty()) {
    nlohmann::json out = to_json(found);
    out["verb"] = "identify";
    out["case"] = options.folder;
    out["remarks"] = recordings.remarks;
    out["figures"] = to_json(figures_of(found.after, found.axis));
    write_json(options.json, out);
  }
  return found.fit.converged ? done : not_so;
}

}  // namespace

std::function<int()> prepare_identify(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("CASE", options->folder, "folder with case.toml, or the file itself")->required();
  app.add_option("--out", options->out, "write the identified axis to this file")->type_name("FILE");
  app.add_flag("--force-offset", options->force_offset,
               "look for a constant force (gravity) beside direction-dependent friction");
  add_json_option(app, options->json);
  return [options] { return run(*options); };
}

}  // namespace feedtwin::tools
