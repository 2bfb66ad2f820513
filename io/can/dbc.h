#pragma once
// The drives' frames for bus monitors, as a DBC, from the object table and the PDOs' default mapping.

#include <string>
#include <vector>

#include "io/can/object_values.h"

namespace feedtwin::io::can {

/// One node a drive.
[[nodiscard]] std::string make_dbc(const std::vector<DriveIdentity>& drives);

}  // namespace feedtwin::io::can
