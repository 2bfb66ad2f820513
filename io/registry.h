#pragma once
// Every kind of port by its name: a new one is one folder and one line in registry.cpp.

#include <memory>
#include <span>
#include <string_view>

#include "io/port.h"
#include "io/settings.h"

namespace feedtwin::io {

/// What a port must know of the axes that it serves.
struct PortContext {
  int axes = 1;
  double tick_s = 1e-3;
  bool lockstep = false;  ///< a port steps the plant: each tick waits for it
  struct Axis {
    double rated_torque_Nm = 1.27;
    double lead_m = 0.005;
    double encoder_counts_per_rev = 65536.0;
  };
  std::vector<Axis> axis;
};

struct PortKind {
  std::string_view name, meaning;
  std::unique_ptr<Port> (*make)(Settings& settings, const PortContext& context);
};

[[nodiscard]] std::span<const PortKind> port_kinds() noexcept;

}  // namespace feedtwin::io
