#include "tools/identify/lanes/follow_kernel_body.h"
#include "tools/identify/lanes/kernel_body.h"

namespace feedtwin::tools::lanes {

KernelEntry avx512_kernel() noexcept {
  // four shapes are half a register
  return {"AVX-512", 8, run_closed_loop<plant::Doubles<8>>, avx2_kernel().inverse, run_follow<plant::Doubles<8>>};
}

}  // namespace feedtwin::tools::lanes
