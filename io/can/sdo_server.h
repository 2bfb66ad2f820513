#pragma once
// SDO server of CiA 301: expedited and segmented transfers. Bytes and time in, bytes and counters out.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/can/frame.h"
#include "io/can/object_values.h"

namespace feedtwin::io::can {

/// What the server reads from and writes to.
class SdoObjects {
 public:
  virtual ~SdoObjects() = default;
  /// Fills `bytes` (at least longest_text of them) and sets `length`.
  virtual Abort sdo_read(std::uint16_t index, std::uint8_t sub, std::span<std::uint8_t> bytes,
                         std::size_t& length) noexcept FEEDTWIN_REALTIME = 0;
  virtual Abort sdo_write(std::uint16_t index, std::uint8_t sub,
                          std::span<const std::uint8_t> bytes) noexcept FEEDTWIN_REALTIME = 0;
};

struct SdoCounters {
  std::uint64_t transfers = 0;  ///< ended well
  std::uint64_t aborted = 0;    ///< refused by the server
  std::uint64_t given_up = 0;   ///< aborted by the client, or left half-done
};

class SdoServer {
 public:
  /// A segmented transfer that rests longer than this is given up.
  static constexpr std::int64_t timeout_ns = 1'000'000'000;

  /// Answer a request of 8 bytes. @return false if there is nothing to answer. Bounded, no allocation.
  bool answer(const Frame& request, std::int64_t now_ns, SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME;
  /// Forget a transfer under way.
  void reset() noexcept FEEDTWIN_REALTIME { transfer_ = Transfer::none; }
  [[nodiscard]] const SdoCounters& counters() const noexcept { return counters_; }

 private:
  enum class Transfer : std::uint8_t { none, upload, download };

  void start_upload(SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME;
  void upload_segment(const Frame& request, Frame& reply) noexcept FEEDTWIN_REALTIME;
  void start_download(const Frame& request, SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME;
  void download_segment(const Frame& request, SdoObjects& objects, Frame& reply) noexcept FEEDTWIN_REALTIME;
  void abort(Abort reason, Frame& reply) noexcept FEEDTWIN_REALTIME;
  void head(std::uint8_t command, Frame& reply) const noexcept FEEDTWIN_REALTIME;

  Transfer transfer_ = Transfer::none;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  bool toggle_ = false;
  std::size_t length_ = 0;     ///< of the whole, as far as known
  std::size_t done_ = 0;       ///< bytes passed so far
  bool length_given_ = false;  ///< the client said it at the start of a download
  std::int64_t last_ns_ = 0;
  std::array<std::uint8_t, longest_text + 8> bytes_{};
  SdoCounters counters_;
};

}  // namespace feedtwin::io::can
