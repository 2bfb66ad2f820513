#pragma once
// Data that is kept beside the checkout and not in it (FEEDTWIN_SHARED, or ../shared): tests that need it skip without.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace feedtwin::tests {

[[nodiscard]] inline std::string shared_path(const std::string& name) {
  const char* given = std::getenv("FEEDTWIN_SHARED");
  const std::filesystem::path beside = std::filesystem::path(FEEDTWIN_SOURCE_DIR) / ".." / "shared";
  return ((given != nullptr ? std::filesystem::path(given) : beside) / name).string();
}

}  // namespace feedtwin::tests

#define FEEDTWIN_NEEDS_SHARED(name)                                                                           \
  if (!std::filesystem::exists(feedtwin::tests::shared_path(name))) {                                         \
    GTEST_SKIP() << feedtwin::tests::shared_path(name) << " is not there (FEEDTWIN_SHARED names its folder)"; \
  }                                                                                                           \
  static_assert(true)
