#include "io/can/sdo_server.h"

#include <algorithm>
#include <cstring>

namespace feedtwin::io::can {
namespace {

// Client command specifiers, bits 7..5 of the first byte.
enum Request : std::uint8_t {
  download_segment_request = 0,
  start_download_request,
  start_upload_request,
  upload_segment_request,
  abort_request
};

constexpr std::uint8_t toggle_bit = 0x10, last_bit = 0x01;

}  // namespace

bool SdoServer::answer(const Frame& request, std::int64_t now_ns, SdoObjects& objects,
                       Frame& reply) noexcept FEEDTWIN_REALTIME {
  if (request.length != 8 || request.remote) return false;
  if (transfer_ != Transfer::none && now_ns - last_ns_ > timeout_ns) {
    transfer_ = Transfer::none;
    ++counters_.given_up;
  }
  last_ns_ = now_ns;
  reply.length = 8;
  reply.data = {};
  const int command = request.data[0] >> 5;
  if (command == start_download_request || command == start_upload_request) {
    if (transfer_ != Transfer::none) ++counters_.given_up;  // a new request ends an old transfer
    transfer_ = Transfer::none;
    index_ = load<std::uint16_t>(request, 1);
    sub_ = request.data[3];
  }
  switch (command) {
    case start_upload_request:
      start_upload(objects, reply);
      return true;
    case start_download_request:
      start_download(request, objects, reply);
      return true;
    case upload_segment_request:
      upload_segment(request, reply);
      return true;
    case download_segment_request:
      download_segment(request, objects, reply);
      return true;
    case abort_request:
      if (transfer_ != Transfer::none) ++counters_.given_up;
      transfer_ = Transfer::none;
      return false;
    default:  // block transfer and what is not defined
      index_ = load<std::uint16_t>(request, 1);
      sub_ = request.data[3];
      abort(Abort::command, reply);
      return true;
  }
}

void SdoServer::head(std::uint8_t command, Frame& reply) const noexcept FEEDTWIN_REALTIME {
  reply.data[0] = command;
  store(reply, 1, index_);
  reply.data[3] = sub_;
}

void SdoServer::abort(Abort reason, Frame& reply) noexcept FEEDTWIN_REALTIME {
  transfer_ = Transfer::none;
  ++counters_.aborted;
  reply.data = {};
  head(0x80, reply);
  store(reply, 4, static_cast<std::uint32_t>(reason));
}

void SdoServer::start_upload(SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME {
  const Abort result = objects.sdo_read(index_, sub_, bytes_, length_);
  if (result != Abort::ok) return abort(result, reply);
  if (length_ <= 4 && length_ > 0) {  // expedited, size indicated
    head(static_cast<std::uint8_t>(0x43 | (4 - length_) << 2), reply);
    std::memcpy(reply.data.data() + 4, bytes_.data(), length_);
    ++counters_.transfers;
    return;
  }
  head(0x41, reply);
  store(reply, 4, static_cast<std::uint32_t>(length_));
  transfer_ = Transfer::upload;
  toggle_ = false;
  done_ = 0;
}

void SdoServer::upload_segment(const Frame& request, Frame& reply) noexcept FEEDTWIN_REALTIME {
  if (transfer_ != Transfer::upload) return abort(Abort::command, reply);
  if (((request.data[0] & toggle_bit) != 0) != toggle_) return abort(Abort::toggle, reply);
  const std::size_t n = std::min<std::size_t>(7, length_ - done_);
  std::memcpy(reply.data.data() + 1, bytes_.data() + done_, n);
  done_ += n;
  const bool last = done_ == length_;
  reply.data[0] = static_cast<std::uint8_t>((toggle_ ? toggle_bit : 0) | (7 - n) << 1 | (last ? last_bit : 0));
  toggle_ = !toggle_;
  if (last) {
    transfer_ = Transfer::none;
    ++counters_.transfers;
  }
}

void SdoServer::start_download(const Frame& request, SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME {
  const bool expedited = (request.data[0] & 2) != 0, sized = (request.data[0] & 1) != 0;
  if (expedited) {
    // Without a size the four bytes count as far as the object is long.
    std::size_t n = sized ? 4U - (request.data[0] >> 2 & 3U) : 4U;
    if (const int entry = entry_of(index_, sub_); !sized && entry != no_entry) {
      const auto own = static_cast<std::size_t>(bytes_of(object_table()[static_cast<std::size_t>(entry)].type));
      if (own != 0) n = own;
    }
    const Abort result = objects.sdo_write(index_, sub_, std::span(request.data).subspan(4, n));
    if (result != Abort::ok) return abort(result, reply);
    ++counters_.transfers;
    head(0x60, reply);
    return;
  }
  const int entry = entry_of(index_, sub_);
  if (entry == no_entry) return abort(object_exists(index_) ? Abort::no_sub : Abort::no_object, reply);
  const auto& object = object_table()[static_cast<std::size_t>(entry)];
  if (object.access != Access::read_write) return abort(Abort::read_only, reply);
  length_ = sized ? load<std::uint32_t>(request, 4) : 0;
  const auto longest = object.type == DataType::text ? longest_text : static_cast<std::size_t>(bytes_of(object.type));
  if (length_ > longest) return abort(Abort::too_long, reply);
  length_given_ = sized;
  transfer_ = Transfer::download;
  toggle_ = false;
  done_ = 0;
  head(0x60, reply);
}

void SdoServer::download_segment(const Frame& request, SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME {
  if (transfer_ != Transfer::download) return abort(Abort::command, reply);
  if (((request.data[0] & toggle_bit) != 0) != toggle_) return abort(Abort::toggle, reply);
  const std::size_t n = 7U - (request.data[0] >> 1 & 7U);
  if (done_ + n > longest_text) return abort(Abort::too_long, reply);
  std::memcpy(bytes_.data() + done_, request.data.data() + 1, n);
  done_ += n;
  if ((request.data[0] & last_bit) != 0) {
    if (length_given_ && done_ != length_) return abort(Abort::length, reply);
    const Abort result = objects.sdo_write(index_, sub_, std::span(bytes_).first(done_));
    if (result != Abort::ok) return abort(result, reply);
    transfer_ = Transfer::none;
    ++counters_.transfers;
  }
  reply.data[0] = static_cast<std::uint8_t>(0x20 | (toggle_ ? toggle_bit : 0));
  toggle_ = !toggle_;
}

}  // namespace feedtwin::io::can
