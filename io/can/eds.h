#pragma once
// The drive's electronic data sheet, CiA 306, from the object table.

#include <string>

#include "io/can/object_values.h"

namespace feedtwin::io::can {

/// @param file_name as it is to stand in [FileInfo]
[[nodiscard]] std::string make_eds(const DriveIdentity& drive, const std::string& file_name);

}  // namespace feedtwin::io::can
