#include "io/can/frame_bits.h"

namespace feedtwin::io::can {
namespace {

/// Counts bits from start of frame to the end of the checksum, and the bits stuffed in after five equal ones.
class StuffedStream {
 public:
  void field(std::uint32_t value, int width) noexcept {
    for (int i = width - 1; i >= 0; --i) data_bit(((value >> i) & 1U) != 0);
  }
  void checksum() noexcept {
    const std::uint32_t crc = crc_;
    for (int i = 14; i >= 0; --i) wire_bit(((crc >> i) & 1U) != 0);
  }
  [[nodiscard]] int bits() const noexcept { return bits_; }

 private:
  void data_bit(bool bit) noexcept {
    const bool next = bit != ((crc_ >> 14 & 1U) != 0);
    crc_ = (crc_ << 1) & 0x7FFFU;
    if (next) crc_ ^= 0x4599U;  // x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1
    wire_bit(bit);
  }
  void wire_bit(bool bit) noexcept {
    ++bits_;
    run_ = run_ > 0 && bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    if (run_ == 5) {  // the stuffed bit is the opposite one, and counts in the next run
      ++bits_;
      last_ = !bit;
      run_ = 1;
    }
  }

  std::uint32_t crc_ = 0;
  int bits_ = 0, run_ = 0;
  bool last_ = true;
};

}  // namespace

int bits_on_the_wire(const Frame& frame) noexcept {
  StuffedStream stream;
  stream.field(0, 1);  // start of frame
  stream.field(frame.id, 11);
  stream.field(frame.remote ? 1U : 0U, 1);
  stream.field(0, 2);  // base format, reserved
  stream.field(frame.length, 4);
  if (!frame.remote) {
    for (int i = 0; i < frame.length; ++i) stream.field(frame.data[static_cast<std::size_t>(i)], 8);
  }
  stream.checksum();
  // not stuffed: checksum delimiter, acknowledge slot and delimiter, end of frame (7), intermission (3)
  return stream.bits() + 13;
}

}  // namespace feedtwin::io::can
