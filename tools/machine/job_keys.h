#pragma once
// The keys of a machine file (TOML), of --set and of --sweep: the one table that reads them.

#include <span>
#include <string>
#include <string_view>

#include "tools/config/toml_file.h"
#include "tools/machine/job.h"

namespace feedtwin::tools {

struct JobKey {
  std::string_view key;
  double& (*in)(MachineJob&);
  double lowest, highest;
  std::string_view meaning;
};

/// Numbers; x.KEY and y.KEY of plant/parameter_table and a few words (apply) come on top.
[[nodiscard]] std::span<const JobKey> job_keys() noexcept;

/// Takes every key of a machine that the file holds; further keys are left to the caller (TomlFile::reject_unknown).
void apply_known(MachineJob& job, TomlFile& file);
/// The same; throws InputError on an unknown key.
void apply(MachineJob& job, TomlFile& file);
/// True for a file that tells of a machine tool, not of an axis.
[[nodiscard]] bool is_machine_file(const TomlFile& file);

/// The built-in machine changed by a file; the built-in one for an empty path.
[[nodiscard]] MachineJob read_job(const std::string& path);

/// "key=value" as on the command line.
void apply_setting(MachineJob& job, const std::string& setting);

}  // namespace feedtwin::tools
