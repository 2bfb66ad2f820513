// feedtwin can-files: the CANopen drives' EDS and DBC, from the table that the code itself works from.

#include "tools/can_files.h"

#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "io/can/dbc.h"
#include "io/can/eds.h"
#include "tools/config/input_error.h"
#include "tools/config/server_config.h"
#include "tools/config/whole_file.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

struct CanFilesOptions {
  std::string config, folder = ".";
  int node_id = 1;
};

int run_can_files(const CanFilesOptions& options) {
  ConfigRequest request;
  request.path = options.config;
  request.with_ports = false;
  const auto context = read_server_config(request).context();
  if (options.node_id + context.axes - 1 > 127) {
    throw InputError(fmt::format("--node-id: {} axes from node {} on end above 127", context.axes, options.node_id));
  }
  std::vector<io::can::DriveIdentity> drives;
  for (std::size_t i = 0; i < context.axis.size(); ++i) {
    const auto& axis = context.axis[i];
    drives.push_back({static_cast<std::uint8_t>(options.node_id + static_cast<int>(i)), axis.rated_torque_Nm,
                      axis.encoder_counts_per_rev, axis.lead_m});
  }
  const std::filesystem::path folder = options.folder;
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw InputError(options.folder, 0, "", "can't be made: " + problem.message());
  // one data sheet an axis, as rated torque and encoder stand in it
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::string name = drives.size() == 1 ? "feedtwin.eds" : fmt::format("feedtwin.axis{}.eds", i);
    write_whole_file((folder / name).string(), io::can::make_eds(drives[i], name));
    fmt::print("written: {}\n", (folder / name).string());
  }
  write_whole_file((folder / "feedtwin.dbc").string(), io::can::make_dbc(drives));
  fmt::print("written: {}\n", (folder / "feedtwin.dbc").string());
  return done;
}

}  // namespace

std::function<int()> prepare_can_files(CLI::App& app) {
  auto options = std::make_shared<CanFilesOptions>();
  app.add_option("CONFIG", options->config, "server configuration or axis file (TOML); without it, the source's axis");
  app.add_option("--out", options->folder, "folder to write to")->type_name("DIR");
  app.add_option("--node-id", options->node_id, "of the first axis; each further axis takes the next one")
      ->check(CLI::Range(1, 127));
  return [options] { return run_can_files(*options); };
}

}  // namespace feedtwin::tools
