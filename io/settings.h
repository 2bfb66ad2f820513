#pragma once
// Where a port gets its settings from. The configuration's reader implements it and says file, line and key on an error,
// so that a port declares each of its keys, with range and preset, where it uses it.

#include <string>
#include <string_view>
#include <vector>

namespace feedtwin::io {

class Settings {
 public:
  virtual ~Settings() = default;
  virtual double number(std::string_view key, double lowest, double highest, double preset) = 0;
  virtual long long integer(std::string_view key, long long lowest, long long highest, long long preset) = 0;
  virtual bool boolean(std::string_view key, bool preset) = 0;
  virtual std::string text(std::string_view key, const std::string& preset) = 0;
  virtual std::string word(std::string_view key, const std::vector<std::string>& allowed, const std::string& preset) = 0;
  /// The value of a key is not acceptable for a reason of the port's own; throws.
  [[noreturn]] virtual void fail(std::string_view key, const std::string& problem) = 0;
};

}  // namespace feedtwin::io
