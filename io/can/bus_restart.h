#pragma once
// `ip link set DEV type can restart`: bring a controller that is off the bus back to it.

namespace feedtwin::io::can {

/// Asks the kernel by rtnetlink (needs CAP_NET_ADMIN; the interface's own restart-ms must be 0). @return false if refused
bool restart_bus(int interface_index) noexcept;

}  // namespace feedtwin::io::can
