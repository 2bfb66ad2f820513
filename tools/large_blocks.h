#pragma once
// What a verb that simulates many runs does with the large blocks of memory that it takes and gives back.

#include <malloc.h>
#include <sys/mman.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>

namespace feedtwin::tools {

/// Freed blocks stay with the process. Simulated runs are blocks of some hundred kilobytes, made and given up thousands of
/// times; by default each goes back to the kernel, which then hands it out again page by page.
inline void keep_freed_memory() noexcept {
  constexpr int largest_block_bytes = 32 << 20, kept_bytes = 1 << 30;  // glibc takes no larger threshold for blocks
  mallopt(M_MMAP_THRESHOLD, largest_block_bytes);
  mallopt(M_TRIM_THRESHOLD, kept_bytes);
}

/// A larger block comes from the kernel each time; asked for in pages of two megabytes it comes in a few rather than in some
/// ten thousand. No more than a wish: a kernel without them gives what it has.
inline void ask_for_large_pages(Eigen::MatrixXd& matrix) noexcept {
  constexpr std::size_t page_bytes = 2 << 20;
  void* first = matrix.data();
  std::size_t bytes = static_cast<std::size_t>(matrix.size()) * sizeof(double);
  if (std::align(page_bytes, page_bytes, first, bytes) != nullptr)
    ::madvise(first, bytes / page_bytes * page_bytes, MADV_HUGEPAGE);
}

}  // namespace feedtwin::tools
