#include "io/registry.h"

namespace feedtwin::io {

std::span<const PortKind> port_kinds() noexcept {
  return {};
}

}  // namespace feedtwin::io
