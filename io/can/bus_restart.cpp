#include "io/can/bus_restart.h"

#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "io/descriptor.h"

namespace feedtwin::io::can {
namespace {

/// A message with nested attributes, as rtnetlink(7) has them.
class Request {
 public:
  explicit Request(int interface_index) noexcept {
    header().nlmsg_len = NLMSG_LENGTH(sizeof(ifinfomsg));
    header().nlmsg_type = RTM_NEWLINK;
    header().nlmsg_flags = NLM_F_REQUEST | NLM_F_ACK;
    ifinfomsg link{};
    link.ifi_family = AF_UNSPEC;
    link.ifi_index = interface_index;
    std::memcpy(bytes_.data() + NLMSG_HDRLEN, &link, sizeof link);
  }
  std::uint32_t add(unsigned short type, const void* data, std::size_t size) noexcept {
    const std::uint32_t at = NLMSG_ALIGN(header().nlmsg_len);
    rtattr attribute{};
    attribute.rta_type = type;
    attribute.rta_len = static_cast<unsigned short>(RTA_LENGTH(size));
    std::memcpy(bytes_.data() + at, &attribute, sizeof attribute);
    if (size > 0) std::memcpy(bytes_.data() + at + RTA_LENGTH(0), data, size);
    header().nlmsg_len = at + RTA_ALIGN(attribute.rta_len);
    return at;
  }
  void end(std::uint32_t nest) noexcept {
    const auto length = static_cast<unsigned short>(header().nlmsg_len - nest);
    std::memcpy(bytes_.data() + nest + offsetof(rtattr, rta_len), &length, sizeof length);
  }
  [[nodiscard]] const void* data() const noexcept { return bytes_.data(); }
  [[nodiscard]] std::size_t size() noexcept { return header().nlmsg_len; }

 private:
  [[nodiscard]] nlmsghdr& header() noexcept { return *reinterpret_cast<nlmsghdr*>(bytes_.data()); }
  alignas(nlmsghdr) std::array<char, 256> bytes_{};
};

}  // namespace

bool restart_bus(int interface_index) noexcept {
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (!socket) return false;
  Request request(interface_index);
  const std::uint32_t restart = 1;
  const auto info = request.add(IFLA_LINKINFO, nullptr, 0);
  request.add(IFLA_INFO_KIND, "can", 3);
  const auto data = request.add(IFLA_INFO_DATA, nullptr, 0);
  request.add(IFLA_CAN_RESTART, &restart, sizeof restart);
  request.end(data);
  request.end(info);
  if (::send(socket.get(), request.data(), request.size(), 0) < 0) return false;
  alignas(nlmsghdr) std::array<char, 1024> answer{};
  const auto got = ::recv(socket.get(), answer.data(), answer.size(), 0);
  nlmsghdr head{};
  if (got < static_cast<ssize_t>(NLMSG_LENGTH(sizeof(nlmsgerr)))) return false;
  std::memcpy(&head, answer.data(), sizeof head);
  nlmsgerr result{};
  std::memcpy(&result, answer.data() + NLMSG_HDRLEN, sizeof result);
  return head.nlmsg_type == NLMSG_ERROR && result.error == 0;
}

}  // namespace feedtwin::io::can
