#include "io/can/eds.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

namespace feedtwin::io::can {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> line{};
  const int length = std::snprintf(line.data(), line.size(), format, values...);
  return {line.data(), std::min(static_cast<std::size_t>(std::max(length, 0)), line.size() - 1)};
}

std::string number(const ObjectEntry& entry, std::int64_t value) {
  if (is_signed(entry.type)) return text("%lld", static_cast<long long>(value));
  return text("0x%0*llX", 2 * bytes_of(entry.type), static_cast<unsigned long long>(value));
}

std::string default_value(const ObjectEntry& entry, const DriveIdentity& drive) {
  if (entry.type == DataType::text) return std::string(entry.text);
  if (entry.preset_kind == Preset::plus_node_id) return "$NODEID+" + number(entry, entry.preset);
  return number(entry, preset_of(entry, drive));
}

const char* access_name(const ObjectEntry& entry) {
  if (entry.access == Access::constant) return "const";
  if (entry.access == Access::read) return "ro";
  if (entry.mappable == Mappable::receive) return "rww";
  return "rw";
}

/// The keys of a variable or of a sub-index.
std::string variable(const ObjectEntry& entry, const std::string& name, const DriveIdentity& drive) {
  std::string out = "ParameterName=" + name + "\nObjectType=0x7\n";
  out += text("DataType=0x%04X\n", static_cast<unsigned>(entry.type));
  out += std::string("AccessType=") + access_name(entry) + "\n";
  out += "DefaultValue=" + default_value(entry, drive) + "\n";
  const bool limited = entry.type != DataType::text && entry.access == Access::read_write &&
                       entry.preset_kind == Preset::fixed && entry.lowest < entry.highest;
  if (limited) out += "LowLimit=" + number(entry, entry.lowest) + "\nHighLimit=" + number(entry, entry.highest) + "\n";
  out += text("PDOMapping=%d\n", entry.mappable == Mappable::no ? 0 : 1);
  if (!entry.unit.empty()) out += ";Unit=" + std::string(entry.unit) + "\n";
  return out;
}

std::string file_info(const std::string& file_name) {
  // Fixed dates: the same program writes the same file.
  return "[FileInfo]\nFileName=" + file_name +
         "\nFileVersion=1\nFileRevision=1\nEDSVersion=4.0\nDescription=Feed drive in cyclic synchronous torque mode, "
         "simulated\n"
         "CreationTime=12:00AM\nCreationDate=01-01-2026\nCreatedBy=feedtwin\n"
         "ModificationTime=12:00AM\nModificationDate=01-01-2026\nModifiedBy=feedtwin\n\n";
}

std::string device_info() {
  std::string out =
      "[DeviceInfo]\nVendorName=feedtwin\nVendorNumber=0x00000000\nProductName=feedtwin drive\nProductNumber=402\n"
      "RevisionNumber=1\nOrderCode=feedtwin\n";
  for (const int kbit : {10, 20, 50, 125, 250, 500, 800, 1000}) out += text("BaudRate_%d=%d\n", kbit, kbit >= 125 ? 1 : 0);
  out += "SimpleBootUpMaster=0\nSimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\n";
  out += text("NrOfRXPDO=%d\nNrOfTXPDO=%d\nLSS_Supported=0\n\n", pdos, pdos);
  // the data types of the gaps that an RPDO may have
  out += "[DummyUsage]\n";
  for (int type = 1; type <= 7; ++type) out += text("Dummy%04d=%d\n", type, type >= 2 ? 1 : 0);
  return out + "\n[Comments]\nLines=1\nLine1=Positions count encoder increments in 32 bits and wrap around.\n\n";
}

/// One of CiA 306's lists: mandatory, optional, manufacturer's.
std::string object_list(const char* name, const std::vector<int>& indices) {
  std::string out = text("[%s]\nSupportedObjects=%zu\n", name, indices.size());
  int n = 0;
  for (const int index : indices) out += text("%d=0x%04X\n", ++n, static_cast<unsigned>(index));
  return out + "\n";
}

std::string object_lists() {
  std::vector<int> mandatory, optional, manufacturer;
  int last = -1;
  for (const auto& entry : object_table()) {
    const int index = entry.index;
    if (index == last) continue;
    last = index;
    const bool must = index == 0x1000 || index == 0x1001 || index == 0x1018;
    (must ? mandatory : index >= 0x2000 && index < 0x6000 ? manufacturer : optional).push_back(index);
  }
  return object_list("MandatoryObjects", mandatory) + object_list("OptionalObjects", optional) +
         object_list("ManufacturerObjects", manufacturer);
}

}  // namespace

std::string make_eds(const DriveIdentity& drive, const std::string& file_name) {
  std::string out = file_info(file_name) + device_info() + object_lists();
  const auto table = object_table();
  for (std::size_t i = 0; i < table.size();) {
    const unsigned index = table[i].index;
    const auto groups = object_groups();
    const auto group = std::ranges::find(groups, index, &ObjectGroup::index);
    if (group == groups.end()) {
      out += text("[%04X]\n", index) + variable(table[i], std::string(table[i].name), drive) + "\n";
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < table.size() && table[end].index == index) ++end;
    out += text("[%04X]\n", index) + "ParameterName=" + std::string(group->name) + "\n";
    out += text("ObjectType=0x%X\nSubNumber=%zu\n\n", static_cast<unsigned>(group->kind), end - i);
    for (; i < end; ++i) {
      out += text("[%04Xsub%X]\n", index, static_cast<unsigned>(table[i].sub)) +
             variable(table[i], std::string(table[i].name), drive) + "\n";
    }
  }
  return out;
}

}  // namespace feedtwin::io::can
