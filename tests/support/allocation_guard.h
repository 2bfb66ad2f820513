#pragma once
// Turns "no allocation" into a test: while a guard lives on a thread, every allocation by that thread is counted.

#include <cstdint>

namespace feedtwin::test {

class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;
  [[nodiscard]] std::uint64_t allocations() const noexcept;
};

}  // namespace feedtwin::test
