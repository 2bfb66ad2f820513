// feedtwin compare: simulation against recording.

#include "tools/compare.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/config/axis_file.h"
#include "tools/identify/comparison.h"
#include "tools/identify/contour.h"
#include "tools/json_option.h"
#include "tools/recording/case.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct CompareOptions {
  std::string folder, axis, other, json;
};

int run_compare(const CompareOptions& options) {
  const Case recordings = read_case(options.folder);
  for (const auto& remark : recordings.remarks) fmt::print(stderr, "feedtwin: {}\n", remark);
  const auto axis = options.axis.empty() ? recordings.axis : read_axis_file(options.axis);
  const CaseComparison comparison = compare_case(recordings, axis);
  std::vector<ContourComparison> contours;
  if (!options.other.empty()) {
    const Case other = read_case(options.other);
    contours = compare_contours(comparison, compare_case(other, other.axis));
  }
  fmt::print("{}{}", to_text(comparison), to_text(contours));
  if (options.json.empty()) return done;
  nlohmann::json out = to_json(comparison);
  out["verb"] = "compare";
  if (!contours.empty()) out["contour_error_m"] = to_json(contours);
  out["case"] = options.folder;
  out["controller"] = recordings.controller ? "of the case" : "stand-in";
  out["remarks"] = recordings.remarks;
  out["figures"] = to_json(figures_of(comparison, axis));
  write_json(options.json, out);
  return done;
}

}  // namespace

std::function<int()> prepare_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  app.add_option("CASE", options->folder, "folder with case.toml, or the file itself")->required();
  app.add_option("--axis", options->axis, "axis file to simulate instead of the case's own")->type_name("FILE");
  app.add_option("--other-axis", options->other, "case of the axis that moved with it: contour errors, run by run")
      ->type_name("CASE");
  add_json_option(app, options->json);
  return [options] { return run_compare(*options); };
}

}  // namespace feedtwin::tools
