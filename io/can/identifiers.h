#pragma once
// Identifiers of CiA 301's services; where several nodes have one each, the node's number comes on top.

#include <cstdint>

namespace feedtwin::io::can {

inline constexpr std::uint16_t nmt_id = 0x000, sync_id = 0x080;
inline constexpr std::uint16_t sdo_reply_id = 0x580, sdo_request_id = 0x600, heartbeat_id = 0x700;
inline constexpr std::uint16_t no_id = 0xFFFF;

}  // namespace feedtwin::io::can
