#pragma once
// A machine run's recording: CSV, a row a sample, columns named quantity_unit.

#include <string>
#include <vector>

#include "tools/machine/machine_run.h"

namespace feedtwin::tools {

/// Throws InputError when it can't be written.
void write_machine_recording(const std::string& path, const std::vector<MachineSample>& samples);

}  // namespace feedtwin::tools
