#pragma once
// A machine run's recording: CSV, a row a sample, columns named quantity_unit.

#include <string>
#include <vector>

#include "tools/machine/machine_run.h"

namespace feedtwin::tools {

/// The columns of a row of the machine, and such a row, without a line end.
[[nodiscard]] std::string machine_columns();
[[nodiscard]] std::string machine_row(const rt::MachineRecord& record);

/// All rows, with reference and contour error besides. Throws InputError when it can't be written.
void write_machine_recording(const std::string& path, const std::vector<MachineSample>& samples);

}  // namespace feedtwin::tools
