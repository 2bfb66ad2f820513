#pragma once
// Lines of a GPIO chip through libgpiod, 1.6 (Debian 12) or 2.x.

#include <memory>
#include <string>
#include <vector>

#include "io/gpio/lines.h"

namespace feedtwin::io::gpio {

struct ChipSettings {
  std::string chip = "/dev/gpiochip0";
  std::vector<unsigned> offsets;
};

[[nodiscard]] std::unique_ptr<Lines> open_chip(ChipSettings settings);

}  // namespace feedtwin::io::gpio
