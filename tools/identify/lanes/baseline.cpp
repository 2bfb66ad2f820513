#include "tools/identify/lanes/follow_kernel_body.h"
#include "tools/identify/lanes/inverse_kernel_body.h"
#include "tools/identify/lanes/kernel_body.h"

namespace feedtwin::tools::lanes {

KernelEntry baseline_kernel() noexcept {
  return {"x86-64", 2, run_closed_loop<plant::Doubles<2>>, run_inverse<plant::Doubles<2>>, run_follow<plant::Doubles<2>>};
}

}  // namespace feedtwin::tools::lanes
