#include "io/can/frame_bits.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace feedtwin::io::can {
namespace {

std::string binary(std::uint32_t value, int width) {
  std::string bits;
  for (int i = width - 1; i >= 0; --i) bits += (value >> i & 1U) != 0 ? '1' : '0';
  return bits;
}

/// The frame written out as a text of bits: checksum by long division, then a 0 or 1 put after each run of five.
int bits_written_out(const Frame& frame) {
  std::string bits = "0" + binary(frame.id, 11) + (frame.remote ? "1" : "0") + "00" + binary(frame.length, 4);
  if (!frame.remote) {
    for (int i = 0; i < frame.length; ++i) bits += binary(frame.data[static_cast<std::size_t>(i)], 8);
  }
  const std::string divisor = "1100010110011001";
  std::string rest = bits + std::string(15, '0');
  for (std::size_t i = 0; i + 15 < rest.size(); ++i) {
    if (rest[i] == '0') continue;
    for (std::size_t k = 0; k < 16; ++k) rest[i + k] = rest[i + k] == divisor[k] ? '0' : '1';
  }
  bits += rest.substr(rest.size() - 15);
  std::string stuffed;
  for (const char bit : bits) {
    stuffed += bit;
    if (stuffed.size() >= 5 && stuffed.substr(stuffed.size() - 5) == std::string(5, bit)) stuffed += bit == '0' ? '1' : '0';
  }
  return static_cast<int>(stuffed.size()) + 1 + 2 + 7 + 3;
}

TEST(FrameBits, EqualTheFrameWrittenOutBitByBit) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    Frame frame;
    frame.id = static_cast<std::uint16_t>(random() % 2048);
    frame.length = static_cast<std::uint8_t>(random() % 9);
    frame.remote = random() % 10 == 0;
    // runs of equal bits are what stuffing is about
    for (auto& byte : frame.data)
      byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : random() % 2 == 0 ? 0x00 : 0xFF);
    ASSERT_EQ(bits_on_the_wire(frame), bits_written_out(frame)) << "id " << frame.id << " length " << int{frame.length};
    if (!frame.remote) {
      ASSERT_LE(bits_on_the_wire(frame), most_bits_on_the_wire(frame.length));
    }
  }
}

TEST(FrameBits, WorstCaseIsFiftyFivePlusTenPerByte) {
  for (int n = 0; n <= 8; ++n) EXPECT_EQ(most_bits_on_the_wire(n), 55 + 10 * n);
}

}  // namespace
}  // namespace feedtwin::io::can
