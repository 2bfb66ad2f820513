#include "tests/support/allocation_guard.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local bool guarded = false;
thread_local std::uint64_t allocations_seen = 0;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (guarded) ++allocations_seen;
  void* const memory = alignment > alignof(std::max_align_t)
                           ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                           : std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// The global operators are replaced for the whole test program.
void* operator new(std::size_t bytes) {
  return allocate(bytes, 0);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
// What std::stable_sort asks for; without these it would pass by the guard, and its memory be freed by another's delete.
void* operator new(std::size_t bytes, const std::nothrow_t& /*tag*/) noexcept {
  if (guarded) ++allocations_seen;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t& tag) noexcept {
  return operator new(bytes, tag);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace feedtwin::test {

AllocationGuard::AllocationGuard() noexcept {
  allocations_seen = 0;
  guarded = true;
}
AllocationGuard::~AllocationGuard() {
  guarded = false;
}
std::uint64_t AllocationGuard::allocations() const noexcept {
  return allocations_seen;
}

}  // namespace feedtwin::test
