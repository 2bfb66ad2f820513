// feedtwin machine: the whole virtual machine tool.

#include "tools/machine/machine.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"
#include "tools/json_option.h"
#include "tools/machine/job_keys.h"
#include "tools/machine/machine_figures.h"
#include "tools/machine/machine_json.h"
#include "tools/machine/machine_recording.h"
#include "tools/machine/machine_run.h"
#include "tools/machine/reproduction.h"
#include "tools/machine/sweep.h"
#include "tools/ranks/ranks.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

constexpr int figure_sample_ticks = 10;

struct MachineOptions {
  std::string config, compare, json, log, program, reproduce;
  std::vector<std::string> set, sweep;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool list_keys = false;
};

void take_program(MachineJob& job, const std::string& path) {
  if (path.empty()) return;
  job.program_text = read_whole_file(path);
  job.program_name = path;
}

int list_keys() {
  for (const auto& key : job_keys())
    fmt::print("{:<36} {:>8g} .. {:<8g} {}\n", key.key, key.lowest, key.highest, key.meaning);
  fmt::print("{:<36} every key of an axis file, for either axis\n", "x.KEY, y.KEY");
  fmt::print(
      "{:<36} other keys: program, x.file, y.file, spindle.motor (A, B), auxiliary.pump_policy (commanded, always, "
      "cutting),\n"
      "{:<36} tool.teeth, cutting.regenerative, controller.block_delete, controller.g54_mm\n",
      "", "");
  return done;
}

int sweep(const MachineJob& job, const MachineOptions& options) {
  std::vector<SweepAxis> axes;
  for (const auto& text : options.sweep) axes.push_back(read_sweep_axis(text));
  const auto points = run_sweep(job, axes, options.threads);
  if (!Ranks::world().first()) return done;  // every rank has the points; one tells of them
  for (const auto& axis : axes) fmt::print("{:>28} ", axis.key);
  fmt::print("{:>10} {:>10} {:>10} {:>12} {:>12}\n", "time_s", "total_J", "mrr_mm3/s", "SEC_J/mm3", "contour_um");
  for (const auto& point : points) {
    for (const double value : point.values) fmt::print("{:>28.6g} ", value);
    const auto& r = point.result;
    fmt::print("{:>10.2f} {:>10.1f} {:>10.3f} {:>12.3f} {:>12.2f}\n", r.time_s, r.energy.total_J(),
               r.removal_rate_m3_per_s() * 1e9, r.specific_energy_J_per_m3() * 1e-9, r.contour_peak_m * 1e6);
  }
  nlohmann::json json{{"sweep", to_json(axes, points)}};
  const auto fit = fit_specific_energy(points);
  if (fit.points > 0) {
    fmt::print("SEC = {:.3f} / MRR + {:.3f} J/mm3, MRR in mm3/s ({} points, rms {:.3f} J/mm3)\n", fit.a_W, fit.b_J_per_mm3,
               fit.points, fit.rms_J_per_mm3);
    json["sec_fit"] = to_json(fit);
    json["figures"] = to_json(sweep_figures(points, fit));
  }
  write_json(options.json, json);
  return done;
}

int run_machine(const MachineOptions& options) {
  if (options.list_keys) return list_keys();
  if (!options.reproduce.empty()) return reproduce(options.reproduce, options.json, options.threads);
  MachineJob job = read_job(options.config);
  take_program(job, options.program);
  // --set changes the job; in a comparison it changes B, so that a what-if is one line
  std::optional<MachineJob> other;
  if (!options.compare.empty()) other = read_job(options.compare == "same" ? options.config : options.compare);
  if (other) take_program(*other, options.program);
  for (const auto& setting : options.set) apply_setting(other ? *other : job, setting);
  if (!options.sweep.empty()) return sweep(job, options);

  const bool figures = !options.json.empty();
  const int every = !options.log.empty() ? 1 : figures ? figure_sample_ticks : 0;
  const MachineResult result = run_machine(job, every);
  nlohmann::json json = to_json(result);
  if (!options.log.empty()) write_machine_recording(options.log, result.samples);
  if (other) {
    const MachineResult b = run_machine(*other, figures ? figure_sample_ticks : 0);
    std::string b_name = other->name;
    for (const auto& setting : options.set) b_name += ", " + setting;
    print_comparison(job.name, result, b_name, b);
    json["compared"] = to_json(b);
    if (figures) {
      auto drawn = machine_figures(result, "A: ");
      for (auto& figure : machine_figures(b, "B: ")) drawn.push_back(std::move(figure));
      json["figures"] = to_json(drawn);
    }
  } else {
    print(job.name, result);
    if (figures) json["figures"] = to_json(machine_figures(result));
  }
  write_json(options.json, json);
  return done;
}

}  // namespace

std::function<int()> prepare_machine(CLI::App& app) {
  auto options = std::make_shared<MachineOptions>();
  app.add_option("CONFIG", options->config, "machine file (TOML); without it, the source's machine and its channel");
  app.add_option("--program", options->program, "G-code to run instead of the machine file's")->type_name("FILE");
  app.add_option("--set", options->set, "change one key of the machine; with --compare, of B alone; --keys lists them")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // one value each, so that CONFIG may follow
  app.add_option("--compare", options->compare, "a second machine file, or \"same\" for this one changed by --set")
      ->type_name("FILE");
  app.add_option("--sweep", options->sweep,
                 "run over values of a key; given again, over the grid; process.mrr_mm3_per_s=1:10:10 fits SEC")
      ->type_name("KEY=FROM:TO:N")
      ->allow_extra_args(false);
  app.add_option("--threads", options->threads, "for a sweep")->check(CLI::Range(1, 1024))->capture_default_str();
  app.add_option("--log,--out", options->log, "write the recording, one row a tick (CSV)")->type_name("FILE");
  app.add_option("--reproduce", options->reproduce,
                 "set the source's Tables 3-5, Figs. 7-11 and Eq. 15 beside this program's (HTML)")
      ->type_name("FILE");
  app.add_flag("--keys", options->list_keys, "list every key of a machine file and end");
  add_json_option(app, options->json);
  return [options] { return run_machine(*options); };
}

}  // namespace feedtwin::tools
