#pragma once

#include "controllers/motion.h"

namespace feedtwin::controllers {

[[nodiscard]] std::unique_ptr<Motion> make_stair(const MotionSettings& settings);

}  // namespace feedtwin::controllers
