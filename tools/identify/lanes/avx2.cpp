#include "tools/identify/lanes/follow_kernel_body.h"
#include "tools/identify/lanes/inverse_kernel_body.h"
#include "tools/identify/lanes/kernel_body.h"

namespace feedtwin::tools::lanes {

KernelEntry avx2_kernel() noexcept {
  return {"AVX2", 4, run_closed_loop<plant::Doubles<4>>, run_inverse<plant::Doubles<4>>, run_follow<plant::Doubles<4>>};
}

}  // namespace feedtwin::tools::lanes
