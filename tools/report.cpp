// feedtwin report: a self-contained HTML page of any run, comparison or diagnosis.

#include "tools/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"
#include "tools/report/page.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct ReportOptions {
  std::string file, out;
};

nlohmann::json read_json(const std::string& path) {
  const std::string text = read_whole_file(path);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())), '\n');
    throw InputError(path, static_cast<std::size_t>(line), "", "expected the JSON that a verb wrote with --json");
  }
}

int run_report(const ReportOptions& options) {
  const nlohmann::json json = read_json(options.file);
  if (!json.is_object()) throw InputError(options.file, 0, "", "expected the JSON object that a verb wrote with --json");
  const std::string verb = json.contains("verb") && json["verb"].is_string() ? json["verb"].get<std::string>() + ": " : "";
  const std::string out =
      options.out.empty() ? std::filesystem::path(options.file).replace_extension(".html").string() : options.out;
  write_whole_file(out, report_page(json, "feedtwin " + verb + std::filesystem::path(options.file).filename().string()));
  fmt::print("{}\n", out);
  return done;
}

}  // namespace

std::function<int()> prepare_report(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  app.add_option("FILE", options->file, "what a verb wrote with --json")->required();
  app.add_option("--out", options->out, "the page; without it, FILE with the ending .html")->type_name("FILE");
  return [options] { return run_report(*options); };
}

}  // namespace feedtwin::tools
