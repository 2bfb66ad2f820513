// What a master may read and write by SDO, and what a write sets going.

#include <cstdint>

#include "io/can/canopen_node.h"

namespace feedtwin::io::can {
namespace {

constexpr std::int64_t exists_not = 0x8000'0000, identifier = 0x1FFF'FFFF;

/// Identifiers that CiA 301 keeps for other services; a PDO may not take them.
bool restricted(std::int64_t id) noexcept FEEDTWIN_REALTIME {
  return id <= 0x180 || (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) || id >= 0x6E0;
}

}  // namespace

Abort CanopenNode::sdo_read(std::uint16_t index, std::uint8_t sub, std::span<std::uint8_t> bytes,
                            std::size_t& length) noexcept FEEDTWIN_REALTIME {
  const int entry = entry_of(index, sub);
  if (entry == no_entry) return object_exists(index) ? Abort::no_sub : Abort::no_object;
  length = objects_.encode(entry, bytes);
  return Abort::ok;
}

Abort CanopenNode::sdo_write(std::uint16_t index, std::uint8_t sub,
                             std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME {
  const int entry = entry_of(index, sub);
  if (entry == no_entry) return object_exists(index) ? Abort::no_sub : Abort::no_object;
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  if (const auto result = ObjectValues::check(object, bytes); result != Abort::ok) return result;
  if (object.type == DataType::text) {
    objects_.set_label(bytes);
    return Abort::ok;
  }
  const auto value = ObjectValues::decode(object.type, bytes);
  if (const auto result = allow(entry, value); result != Abort::ok) return result;
  objects_.set(entry, value);
  if (entry == entry_.controlword || entry == entry_.target_torque) {
    pending_.command_ns = pending_.now_ns;
    pending_.fresh_command = true;
  }
  written(entry);
  return Abort::ok;
}

/// Rules that go beyond an entry's limits.
Abort CanopenNode::allow(int entry, std::int64_t value) noexcept FEEDTWIN_REALTIME {
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  switch (object.index) {
    case 0x6060:  // 0: no change of mode
      return value == 0 || value == 10 ? Abort::ok : Abort::value;
    case 0x605A:
      return value == 0 || value == 2 || value == 3 || value == 6 || value == 7 ? Abort::ok : Abort::value;
    case 0x605E:
      return value == 0 || value == 2 ? Abort::ok : Abort::value;
    case 0x1016:
      return (value >> 16 & 0xFF) <= 127 && value >> 24 == 0 ? Abort::ok : Abort::value;
    default:
      return allow_pdo(entry, value);
  }
}

CanopenNode::Pdo* CanopenNode::pdo_of(int entry, Mappable& direction, bool& mapping) noexcept FEEDTWIN_REALTIME {
  const int index = object_table()[static_cast<std::size_t>(entry)].index;
  const int number = index & 0xFF, group = index & 0xFF00;
  if (number >= pdos) return nullptr;
  direction = group >= 0x1800 ? Mappable::transmit : Mappable::receive;
  mapping = group == 0x1600 || group == 0x1A00;
  if (group == 0x1400 || group == 0x1600) return &rpdo_[static_cast<std::size_t>(number)];
  if (group == 0x1800 || group == 0x1A00) return &tpdo_[static_cast<std::size_t>(number)];
  return nullptr;
}

Abort CanopenNode::allow_pdo(int entry, std::int64_t value) noexcept FEEDTWIN_REALTIME {
  Mappable direction{};
  bool mapping = false;
  const Pdo* pdo = pdo_of(entry, direction, mapping);
  if (pdo == nullptr) return Abort::ok;
  const int sub = object_table()[static_cast<std::size_t>(entry)].sub;
  if (mapping) {  // CiA 301: take the PDO off, set the count to 0, map, set the count, put the PDO on
    if (pdo->exists) return Abort::unsupported_access;
    if (sub == 0) {
      PdoMapping trial;
      return resolve(objects_, pdo->map + 1, static_cast<int>(value), direction, trial);
    }
    if (at(pdo->map) != 0) return Abort::sub_0_first;
    PdoMapping::Part trial;
    return value == 0 ? Abort::ok : resolve(static_cast<std::uint32_t>(value), direction, trial);
  }
  if (sub == 1) {
    if (pdo->exists && ((value ^ at(entry)) & identifier) != 0) return Abort::value;  // only when taken off
    const bool extended = (value & 0x2000'0000) != 0;
    const bool put_on = (value & exists_not) == 0;
    return extended || (put_on && restricted(value & identifier)) ? Abort::value : Abort::ok;
  }
  if (sub == 2) return value <= 240 || value >= 254 ? Abort::ok : Abort::value;  // no remote-requested PDOs
  return Abort::ok;
}

void CanopenNode::written(int entry) noexcept FEEDTWIN_REALTIME {
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  Mappable direction{};
  bool mapping = false;
  if (Pdo* pdo = pdo_of(entry, direction, mapping); pdo != nullptr) {
    configure(*pdo, direction);
    publish_ids();
  }
  switch (object.index) {
    case 0x1003:  // 0 clears the history
      for (int i = 1; i <= error_history; ++i) objects_.set(entry + i, 0);
      break;
    case 0x1016:
      master_.disarm();
      publish_ids();
      break;
    case 0x1017:
      heartbeat_.restart();
      break;
    case 0x2010:
    case 0x2011:
    case 0x2012:
      machine_changed_ = true;
      break;
    case 0x6060:
      if (at(entry) != 0) objects_.set(entry_.mode_shown, at(entry));
      pending_.changed = true;
      break;
    case 0x6040:
    case 0x6071:
    case 0x6072:
    case 0x60B2:
      pending_.changed = true;
      break;
    default:
      break;
  }
}

void CanopenNode::configure(Pdo& pdo, Mappable direction) noexcept FEEDTWIN_REALTIME {
  const auto cob_id = at(pdo.communication + 1);
  pdo.cob_id = static_cast<std::uint16_t>(cob_id & largest_id);
  pdo.type = static_cast<int>(at(pdo.communication + 2));
  pdo.mapping = {};
  const bool mapped = resolve(objects_, pdo.map + 1, static_cast<int>(at(pdo.map)), direction, pdo.mapping) == Abort::ok;
  pdo.exists = (cob_id & exists_not) == 0 && mapped && pdo.mapping.count > 0;
  pdo.pending = pdo.sent = false;
  pdo.syncs = 0;
}

void CanopenNode::configure_all() noexcept FEEDTWIN_REALTIME {
  for (auto& pdo : rpdo_) configure(pdo, Mappable::receive);
  for (auto& pdo : tpdo_) configure(pdo, Mappable::transmit);
  publish_ids();
}

}  // namespace feedtwin::io::can
