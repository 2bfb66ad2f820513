#include "io/udp/datagram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/drive_words.h"

namespace feedtwin::io::udp {
namespace {

static_assert(std::endian::native == std::endian::little, "the fields are copied as they are");

constexpr std::array<std::uint8_t, 4> magic{'F', 'T', 'W', 'N'};
constexpr std::uint8_t version = 1, kind_request = 1, kind_reply = 2;

template <class Field>
Field get(std::span<const std::uint8_t> bytes, std::size_t at) noexcept FEEDTWIN_REALTIME {
  Field field;
  std::memcpy(&field, bytes.data() + at, sizeof field);
  return field;
}

template <class Field>
void put(std::span<std::uint8_t> bytes, std::size_t at, Field field) noexcept FEEDTWIN_REALTIME {
  std::memcpy(bytes.data() + at, &field, sizeof field);
}

}  // namespace

bool decode(std::span<const std::uint8_t> bytes, std::size_t plant_axes, Request& request) noexcept {
  if (bytes.size() < request_header_bytes || !std::equal(magic.begin(), magic.end(), bytes.begin())) return false;
  const std::size_t axes = bytes[6];
  if (bytes[4] != version || bytes[5] != kind_request || axes < 1 || axes > plant_axes || axes > max_axes) return false;
  if (bytes.size() != request_header_bytes + request_axis_bytes * axes) return false;

  const double speed_rad_per_s = static_cast<double>(get<float>(bytes, 12));
  const double depth_of_cut_m = static_cast<double>(get<float>(bytes, request_header_bytes + 12));
  if (!std::isfinite(speed_rad_per_s) || !std::isfinite(depth_of_cut_m)) return false;
  request.machine = machine_request(speed_rad_per_s, bytes[7], depth_of_cut_m);
  request.sequence = get<std::uint32_t>(bytes, 8);
  request.stamp = get<std::uint64_t>(bytes, 16);
  request.axes = axes;
  for (std::size_t i = 0; i < axes; ++i) {
    const auto field = bytes.subspan(request_header_bytes + request_axis_bytes * i, request_axis_bytes);
    AxisRequest axis;
    axis.torque_Nm = get<double>(field, 0);
    set_control(axis, get<std::uint16_t>(field, 8));
    axis.watchdog_ns = get<std::uint16_t>(field, 10) * std::int64_t{1'000'000};
    request.axis[i] = axis;
  }
  return true;
}

std::size_t encode(const Reply& reply, std::span<const AxisReport> axes,
                   std::span<std::uint8_t, largest_reply_bytes> bytes) noexcept {
  const std::size_t count = std::min<std::size_t>(axes.size(), max_axes);
  const std::size_t size = reply_header_bytes + reply_axis_bytes * count;
  std::fill_n(bytes.begin(), size, std::uint8_t{0});
  std::copy(magic.begin(), magic.end(), bytes.begin());
  bytes[4] = version;
  bytes[5] = kind_reply;
  bytes[6] = static_cast<std::uint8_t>(count);
  put(bytes, 8, reply.sequence);
  put(bytes, 16, reply.stamp);
  put(bytes, 24, reply.tick.tick);
  put(bytes, 32, reply.tick.missed_ticks);
  put(bytes, 40, count > 0 ? axes[0].input_age_ns : std::int64_t{-1});
  for (std::size_t i = 0; i < count; ++i) {
    const auto field = std::span<std::uint8_t>(bytes).subspan(reply_header_bytes + reply_axis_bytes * i, reply_axis_bytes);
    put(field, 0, axes[i].encoder_counts);
    put(field, 8, axes[i].velocity_m_per_s);
    put(field, 16, axes[i].torque_Nm);
    put(field, 24, statusword(axes[i]));
  }
  return size;
}

}  // namespace feedtwin::io::udp
