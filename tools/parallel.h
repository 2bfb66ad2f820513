#pragma once
// Independent pieces of work on all cores; the result does not depend on how many there are.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace feedtwin::tools {

namespace detail {
/// Is this thread at a piece of such work already? Then all cores are busy, and what it asks for it does by itself.
inline thread_local bool at_a_piece = false;
struct AtAPiece {
  AtAPiece() { at_a_piece = true; }
  ~AtAPiece() { at_a_piece = false; }  // whatever the work throws
  AtAPiece(const AtAPiece&) = delete;
  AtAPiece& operator=(const AtAPiece&) = delete;
};
}  // namespace detail

template <class Work>
void parallel_for(std::size_t count, const Work& work) {
  const std::size_t cores = detail::at_a_piece ? 1 : std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = std::min(count, cores);
  if (threads < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  const auto worker = [&] {
    const detail::AtAPiece here;
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> pool;
  for (std::size_t t = 1; t < threads; ++t) pool.emplace_back(worker);
  worker();
}

}  // namespace feedtwin::tools
