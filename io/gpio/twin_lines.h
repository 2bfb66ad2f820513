#pragma once
// Lines inside the process that remember every change, for tests.

#include <cstdint>
#include <functional>

#include "io/gpio/lines.h"

namespace feedtwin::io::gpio {

class TwinLines final : public Lines {
 public:
  /// @param seen called with every state that is set, in order
  explicit TwinLines(std::function<void(std::uint64_t)> seen) : seen_(std::move(seen)) {}

  void open(std::uint64_t levels) override { seen_(levels); }
  void close() noexcept override {}
  bool set(std::uint64_t levels) noexcept override {
    seen_(levels);
    return true;
  }

 private:
  std::function<void(std::uint64_t)> seen_;
};

}  // namespace feedtwin::io::gpio
