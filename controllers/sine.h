#pragma once

#include <memory>

#include "controllers/motion.h"

namespace feedtwin::controllers {

[[nodiscard]] std::unique_ptr<Motion> make_sine(const MotionSettings& settings);

}  // namespace feedtwin::controllers
