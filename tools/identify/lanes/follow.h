#pragma once
// Any number of motions with a parameter set each, followed in lanes of what this processor has, on all its cores.

#include <span>

#include "tools/identify/lanes/follow_kernel.h"

namespace feedtwin::tools::lanes {

void follow_friction(std::span<const FollowedMotion> motions);

}  // namespace feedtwin::tools::lanes
