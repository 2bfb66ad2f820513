#include "io/modbus/request.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/io/modbus/frames.h"

namespace feedtwin::io::modbus {
namespace {

using namespace test;

constexpr Extent two_axes{.commands = 32, .mirror_begin = 2000, .inputs = 64};

Refusal refusal(const Bytes& bytes) {
  return check(bytes, two_axes).refusal;
}

TEST(Request, AFrameIsCutByItsOwnLengthAtEverySplit) {
  const Bytes first = read(3, 0, 4), second = write_many(0, {1, 2, 3});
  Bytes stream = first;
  stream.insert(stream.end(), second.begin(), second.end());
  for (std::size_t n = 0; n < first.size(); ++n) {
    const Cut cut = cut_frame(std::span(stream).first(n));
    EXPECT_EQ(cut.bytes, 0U) << n;
    EXPECT_FALSE(cut.malformed) << n;
  }
  EXPECT_EQ(cut_frame(stream).bytes, first.size());
  EXPECT_EQ(cut_frame(std::span(stream).subspan(first.size())).bytes, second.size());
}

TEST(Request, WhatIsNoModbusIsMalformed) {
  for (std::size_t at = 2; at < 6; ++at) {
    Bytes bytes = read(3, 0, 1);
    bytes[at] = 0xFF;
    EXPECT_TRUE(cut_frame(bytes).malformed || at == 5) << at;  // a length of 255 is one too many, so at 5 too
  }
  for (unsigned length = 0; length <= 0xFFFF; ++length) {
    Bytes bytes = read(3, 0, 1);
    bytes[4] = static_cast<std::uint8_t>(length >> 8);
    bytes[5] = static_cast<std::uint8_t>(length);
    ASSERT_EQ(cut_frame(bytes).malformed, length < 2 || length > 254) << length;
  }
}

TEST(Request, OnlyTheServedFunctions) {
  for (unsigned function = 0; function < 256; ++function) {
    const bool served = function == 3 || function == 4 || function == 6 || function == 16 || function == 23;
    ASSERT_EQ(refusal(frame(pdu(static_cast<std::uint8_t>(function), {0, 1}))) == Refusal::illegal_function, !served)
        << function;
  }
}

TEST(Request, NumbersOfRegisters) {
  for (const std::uint8_t function : {std::uint8_t{3}, std::uint8_t{4}}) {
    EXPECT_EQ(refusal(read(function, 0, 0)), Refusal::illegal_value);
    EXPECT_EQ(refusal(read(function, 0, 126)), Refusal::illegal_value);
    EXPECT_EQ(refusal(read(function, 0, 65535)), Refusal::illegal_value);
    EXPECT_EQ(refusal(read(function, 0, 32)), Refusal::none);
  }
  EXPECT_EQ(refusal(write_many(0, {})), Refusal::illegal_value);
  EXPECT_EQ(refusal(write_many(0, std::vector<std::uint16_t>(123))), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_many(0, std::vector<std::uint16_t>(124))), Refusal::illegal_value);
  EXPECT_EQ(refusal(write_and_read(0, std::vector<std::uint16_t>(121), 0, 1)), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_and_read(0, std::vector<std::uint16_t>(122), 0, 1)), Refusal::illegal_value);
  EXPECT_EQ(refusal(write_and_read(0, {1}, 0, 0)), Refusal::illegal_value);
  EXPECT_EQ(refusal(write_and_read(0, {}, 0, 1)), Refusal::illegal_value);
}

TEST(Request, EveryAddressAtTheEdges) {
  EXPECT_EQ(refusal(read(3, 31, 1)), Refusal::none);
  EXPECT_EQ(refusal(read(3, 31, 2)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(3, 1999, 1)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(3, 1999, 2)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(3, 2000, 64)), Refusal::none);
  EXPECT_EQ(refusal(read(3, 2001, 64)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(3, 65535, 1)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(3, 65535, 125)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(4, 0, 64)), Refusal::none);
  EXPECT_EQ(refusal(read(4, 1, 64)), Refusal::illegal_address);
  EXPECT_EQ(refusal(read(4, 2000, 1)), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_one(31, 0)), Refusal::none);
  EXPECT_EQ(refusal(write_one(32, 0)), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_one(2000, 0)), Refusal::illegal_address) << "the mirror is for reading";
  EXPECT_EQ(refusal(write_many(30, {1, 2})), Refusal::none);
  EXPECT_EQ(refusal(write_many(30, {1, 2, 3})), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_and_read(0, {1}, 2000, 12)), Refusal::none);
  EXPECT_EQ(refusal(write_and_read(2000, {1}, 0, 12)), Refusal::illegal_address);
  EXPECT_EQ(refusal(write_and_read(0, {1}, 40, 12)), Refusal::illegal_address);
}

TEST(Request, LengthsThatContradictThemselves) {
  const Bytes good[] = {read(3, 0, 1), read(4, 0, 1), write_one(0, 1), write_many(0, {1, 2}), write_and_read(0, {1}, 0, 1)};
  for (const Bytes& whole : good) {
    ASSERT_EQ(refusal(whole), Refusal::none);
    for (std::size_t n = header_bytes + 1; n < whole.size(); ++n)
      EXPECT_EQ(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n))), Refusal::illegal_value) << n;
    Bytes longer = whole;
    longer.push_back(0);
    EXPECT_EQ(refusal(longer), Refusal::illegal_value);
  }
  Bytes wrong_count = write_many(0, {1, 2});
  wrong_count[header_bytes + 5] = 2;
  EXPECT_EQ(refusal(wrong_count), Refusal::illegal_value);
}

TEST(Request, RandomBytesNeverPointOutsideTheRegistersOrTheFrame) {
  std::mt19937 random(3);
  const std::uint8_t functions[] = {3, 4, 6, 16, 23};
  int accepted = 0;
  for (int i = 0; i < 200'000; ++i) {
    Bytes bytes(header_bytes + 1 + random() % 40);
    for (auto& byte : bytes)
      byte = static_cast<std::uint8_t>(random() % 2 == 0 ? 0 : random() % 8 == 0 ? random() : random() % 34);
    bytes[header_bytes] = functions[random() % 5];
    // let the numbers agree now and then
    const std::size_t count_at = bytes[header_bytes] == 16 ? 12 : 16;
    if (bytes[header_bytes] >= 16 && bytes.size() > count_at + 1) {
      bytes[count_at] = static_cast<std::uint8_t>(bytes.size() - count_at - 1);
      bytes[count_at - 1] = bytes[count_at] / 2;
    }
    const Request request = check(bytes, two_axes);
    if (request.refusal != Refusal::none) continue;
    ++accepted;
    ASSERT_EQ(request.written.size(), 2 * request.write.count);
    ASSERT_TRUE(request.write.count == 0 || request.write.begin + request.write.count <= 32);
    if (request.written.size() > 0) {
      ASSERT_GE(request.written.data(), bytes.data());
      ASSERT_LE(request.written.data() + request.written.size(), bytes.data() + bytes.size());
    }
  }
  EXPECT_GT(accepted, 100) << "the test would show nothing";
}

}  // namespace
}  // namespace feedtwin::io::modbus
