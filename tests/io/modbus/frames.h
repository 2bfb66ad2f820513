#pragma once
// Modbus TCP requests and replies in bytes, for tests; written from the standard and not with the code under test.

#include <cstdint>
#include <vector>

namespace feedtwin::io::modbus::test {

using Bytes = std::vector<std::uint8_t>;

inline void put(Bytes& bytes, unsigned word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

inline Bytes frame(const Bytes& pdu, unsigned transaction = 1) {
  Bytes bytes;
  put(bytes, transaction);
  put(bytes, 0);
  put(bytes, static_cast<unsigned>(pdu.size() + 1));
  bytes.push_back(1);
  bytes.insert(bytes.end(), pdu.begin(), pdu.end());
  return bytes;
}

inline Bytes pdu(std::uint8_t function, std::initializer_list<unsigned> words) {
  Bytes bytes{function};
  for (const unsigned word : words) put(bytes, word);
  return bytes;
}

inline Bytes read(std::uint8_t function, unsigned address, unsigned count, unsigned transaction = 1) {
  return frame(pdu(function, {address, count}), transaction);
}

inline Bytes write_one(unsigned address, unsigned value, unsigned transaction = 1) {
  return frame(pdu(6, {address, value}), transaction);
}

inline void put_values(Bytes& bytes, const std::vector<std::uint16_t>& values) {
  bytes.push_back(static_cast<std::uint8_t>(2 * values.size()));
  for (const auto value : values) put(bytes, value);
}

inline Bytes write_many(unsigned address, const std::vector<std::uint16_t>& values, unsigned transaction = 1) {
  Bytes bytes = pdu(16, {address, static_cast<unsigned>(values.size())});
  put_values(bytes, values);
  return frame(bytes, transaction);
}

inline Bytes write_and_read(unsigned write_at, const std::vector<std::uint16_t>& values, unsigned read_at, unsigned count,
                            unsigned transaction = 1) {
  Bytes bytes = pdu(23, {read_at, count, write_at, static_cast<unsigned>(values.size())});
  put_values(bytes, values);
  return frame(bytes, transaction);
}

/// The registers of a reply to a read; empty if it is none.
inline std::vector<std::uint16_t> registers(const Bytes& reply) {
  std::vector<std::uint16_t> values;
  if (reply.size() < 9 || (reply[7] & 0x80) != 0 || reply.size() != 9U + reply[8]) return values;
  for (std::size_t i = 9; i + 1 < reply.size(); i += 2)
    values.push_back(static_cast<std::uint16_t>(reply[i] << 8 | reply[i + 1]));
  return values;
}

/// The exception code of a reply; 0 if it is none, -1 if there is no reply.
inline int exception_of(const Bytes& reply) {
  if (reply.size() < 8) return -1;
  return (reply[7] & 0x80) != 0 && reply.size() == 9 ? reply[8] : 0;
}

}  // namespace feedtwin::io::modbus::test
