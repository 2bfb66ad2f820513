#pragma once
// [[fault]]: faults on purpose in a configuration.

#include <string>
#include <vector>

#include "io/faults/fault.h"
#include "io/registry.h"
#include "tools/config/toml_file.h"

namespace feedtwin::tools {

struct ConfiguredFault {
  io::faults::Fault fault;
  std::string port;  ///< that it acts on; empty: every port
};

/// Throws InputError. @param ports the names that `port` may be; @param controller whose commands are meant where none is
/// given
[[nodiscard]] std::vector<ConfiguredFault> faults_from(TomlFile& file, const std::vector<std::string>& ports,
                                                       const std::string& controller, int axes);

/// Those that act on a port.
[[nodiscard]] std::vector<io::faults::Fault> faults_of(const std::vector<ConfiguredFault>& faults, std::string_view port);

}  // namespace feedtwin::tools
