#include "tools/diagnose.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/config/axis_file.h"
#include "tools/diagnose/diagnosis.h"
#include "tools/diagnose/diagnosis_json.h"
#include "tools/diagnose/hil.h"
#include "tools/json_option.h"
#include "tools/large_blocks.h"
#include "tools/recording/case.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct DiagnoseOptions {
  std::string folder, json, axis;
  bool hil = false;
  double hil_s = 0.0;
};

void print(const diagnosis::Diagnosis& found) {
  fmt::print("{}: {}\n", found.verdict, found.summary);
  for (const auto& effect : found.effects)
    fmt::print("  {}\n    {}\n", diagnosis::told_id(*effect.hypothesis), effect.sentence);
  for (const auto& [channel, f] : found.holdout)
    fmt::print("  held out {}: nrmse {:.4f} before, {:.4f} recalibrated, {:.4f} after, {:.4f} noise\n", channel, f.before,
               f.recalibrated, f.after, f.floor);
}

void print(const diagnosis::HilComparison& hil) {
  fmt::print("  server in real time along {}, {:.1f} s, {} ticks, {} missed\n", hil.recording, hil.duration_s,
             hil.before.ticks + hil.after.ticks, hil.before.missed_ticks + hil.after.missed_ticks);
  for (const auto& [channel, before] : hil.before.nrmse)
    fmt::print("  server {}: nrmse {:.4f} with the nominal axis, {:.4f} with the updated one\n", channel, before,
               hil.after.nrmse.at(channel));
}

int run_diagnose(const DiagnoseOptions& options) {
  keep_freed_memory();
  const Case data = read_case(options.folder);
  for (const auto& remark : data.remarks) fmt::print(stderr, "feedtwin: {}\n", remark);
  const auto progress = [](std::string_view what) { fmt::print(stderr, "diagnose: {}\n", what); };
  const auto found = diagnosis::diagnose(data, progress);
  std::string axis_file = options.axis;
  if (axis_file.empty() && !options.json.empty())
    axis_file = (std::filesystem::absolute(options.json).parent_path() / "axis.updated.toml").string();
  if (!axis_file.empty()) write_axis_file(axis_file, found.updated);
  print(found);
  auto json = diagnosis::to_json(found, axis_file);
  json["controller"] = data.controller ? "of the case" : "stand-in";
  json["remarks"] = data.remarks;
  if (options.hil) {
    const auto hil = diagnosis::run_hil({data, data.axis, found.updated, options.hil_s}, progress);
    print(hil);
    json["hil"] = diagnosis::to_json(hil);
  }
  write_json(options.json, json);
  return done;
}

}  // namespace

std::function<int()> prepare_diagnose(CLI::App& app) {
  auto options = std::make_shared<DiagnoseOptions>();
  app.add_option("CASE", options->folder, "folder of the case, or its case.toml")->required();
  add_json_option(app, options->json);
  app.add_option("--axis", options->axis, "write the updated axis here; by default axis.updated.toml beside the JSON")
      ->type_name("FILE");
  app.add_flag("--hil", options->hil,
               "then run the real-time server along the held-out recording, with the nominal axis and with the updated one");
  app.add_option("--hil-seconds", options->hil_s, "of it; 0: to the recording's end")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  return [options] { return run_diagnose(*options); };
}

}  // namespace feedtwin::tools
