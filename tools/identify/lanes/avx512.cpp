#include "tools/identify/lanes/follow_kernel_body.h"
#include "tools/identify/lanes/inverse_kernel_body.h"
#include "tools/identify/lanes/kernel_body.h"

namespace feedtwin::tools::lanes {

KernelEntry avx512_kernel() noexcept {
  return {"AVX-512", 8, run_closed_loop<plant::Doubles<8>>, run_inverse<plant::Doubles<8>>, run_follow<plant::Doubles<8>>};
}

}  // namespace feedtwin::tools::lanes
