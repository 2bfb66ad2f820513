#include "io/can/dbc.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

#include "io/can/pdo.h"

namespace feedtwin::io::can {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> line{};
  const int length = std::snprintf(line.data(), line.size(), format, values...);
  return {line.data(), std::min(static_cast<std::size_t>(std::max(length, 0)), line.size() - 1)};
}

/// "Target torque" -> "TargetTorque": DBC names are C identifiers.
std::string identifier(std::string_view name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) == 0) {
      upper = true;
      continue;
    }
    out += upper ? static_cast<char>(std::toupper(letter)) : c;
    upper = false;
  }
  return out;
}

/// Signal at a byte; little-endian. A torque in per mille of rated is shown in N m, which is what a reader wants to see.
std::string signal(const ObjectEntry& entry, int byte, const DriveIdentity& drive, const std::string& receiver) {
  const int bits = 8 * bytes_of(entry.type);
  const bool torque = entry.unit.starts_with("1/1000");
  const double factor = torque ? drive.rated_torque_Nm * 1e-3 : 1.0;
  const std::string unit = torque ? "Nm" : std::string(entry.unit);
  return text(" SG_ %s : %d|%d@1%c (%.9g,0) [%.9g|%.9g] \"%s\" %s\n", identifier(entry.name).c_str(), 8 * byte, bits,
              is_signed(entry.type) ? '-' : '+', factor, static_cast<double>(entry.lowest) * factor,
              static_cast<double>(entry.highest) * factor, unit.c_str(), receiver.c_str());
}

std::string process_data(const DriveIdentity& drive, const std::string& node, int number, Mappable direction) {
  const ObjectValues objects(drive);
  const bool out = direction == Mappable::transmit;
  const int communication = entry_of(static_cast<std::uint16_t>((out ? 0x1800 : 0x1400) + number), 1);
  const int map = entry_of(static_cast<std::uint16_t>((out ? 0x1A00 : 0x1600) + number), 0);
  PdoMapping mapping;
  if (resolve(objects, map + 1, static_cast<int>(objects.get(map)), direction, mapping) != Abort::ok || mapping.count == 0)
    return {};
  const auto id = static_cast<unsigned>(objects.get(communication) & largest_id);
  std::string message = text("BO_ %u %s_%s%d: %d %s\n", id, node.c_str(), out ? "TPDO" : "RPDO", number + 1, mapping.bytes,
                             out ? node.c_str() : "Master");
  int byte = 0;
  for (int i = 0; i < mapping.count; ++i) {
    const auto& part = mapping.parts[static_cast<std::size_t>(i)];
    if (part.entry != no_entry) {
      message += signal(object_table()[static_cast<std::size_t>(part.entry)], byte, drive, out ? "Master" : node);
    }
    byte += part.bytes;
  }
  return message + "\n";
}

}  // namespace

std::string make_dbc(const std::vector<DriveIdentity>& drives) {
  std::string nodes, messages;
  messages +=
      "BO_ 128 SYNC: 0 Master\n\nBO_ 0 NMT: 2 Master\n SG_ Command : 0|8@1+ (1,0) [0|255] \"\" Vector__XXX\n"
      " SG_ Node : 8|8@1+ (1,0) [0|127] \"\" Vector__XXX\n\n";
  std::string values;
  for (const auto& drive : drives) {
    const std::string node = text("Drive%d", drive.node_id);
    nodes += " " + node;
    for (int i = 0; i < pdos; ++i) messages += process_data(drive, node, i, Mappable::receive);
    for (int i = 0; i < pdos; ++i) messages += process_data(drive, node, i, Mappable::transmit);
    messages += text("BO_ %u %s_EMCY: 8 %s\n", 0x80U + drive.node_id, node.c_str(), node.c_str());
    messages +=
        " SG_ ErrorCode : 0|16@1+ (1,0) [0|65535] \"\" Master\n SG_ ErrorRegister : 16|8@1+ (1,0) [0|255] \"\" Master\n\n";
    const unsigned heartbeat = 0x700U + drive.node_id;
    messages += text("BO_ %u %s_Heartbeat: 1 %s\n", heartbeat, node.c_str(), node.c_str());
    messages += " SG_ State : 0|8@1+ (1,0) [0|127] \"\" Master\n\n";
    values += text("VAL_ %u State 0 \"boot-up\" 4 \"stopped\" 5 \"operational\" 127 \"pre-operational\" ;\n", heartbeat);
  }
  return "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: Master" + nodes + "\n\n" + messages + values;
}

}  // namespace feedtwin::io::can
