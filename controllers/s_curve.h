#pragma once

#include <memory>

#include "controllers/motion.h"

namespace feedtwin::controllers {

[[nodiscard]] std::unique_ptr<Motion> make_s_curve(const MotionSettings& settings);

}  // namespace feedtwin::controllers
