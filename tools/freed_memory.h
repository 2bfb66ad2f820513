#pragma once
// What a verb that simulates many runs does with the memory that it gives back.

#include <malloc.h>

namespace feedtwin::tools {

/// Freed blocks stay with the process. Simulated runs are blocks of some hundred kilobytes, made and given up thousands of
/// times; by default each goes back to the kernel, which then hands it out again page by page.
inline void keep_freed_memory() noexcept {
  constexpr int largest_block_bytes = 32 << 20, kept_bytes = 1 << 30;  // glibc takes no larger threshold for blocks
  mallopt(M_MMAP_THRESHOLD, largest_block_bytes);
  mallopt(M_TRIM_THRESHOLD, kept_bytes);
}

}  // namespace feedtwin::tools
