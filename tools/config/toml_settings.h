#pragma once
// A port's settings out of a table of a TOML file.

#include <string>

#include "io/settings.h"
#include "tools/config/toml_file.h"

namespace feedtwin::tools {

class TomlSettings final : public io::Settings {
 public:
  /// @param table where the keys stand ("port[0]"); `file` must outlive this.
  TomlSettings(TomlFile& file, std::string table) : file_(file), table_(std::move(table)) {}

  double number(std::string_view key, double lowest, double highest, double preset) override {
    return file_.number(at(key), lowest, highest, preset);
  }
  long long integer(std::string_view key, long long lowest, long long highest, long long preset) override {
    return file_.integer(at(key), lowest, highest, preset);
  }
  bool boolean(std::string_view key, bool preset) override { return file_.boolean(at(key), preset); }
  std::string text(std::string_view key, const std::string& preset) override { return file_.text(at(key), preset); }
  std::string word(std::string_view key, const std::vector<std::string>& allowed, const std::string& preset) override {
    return file_.word(at(key), allowed, preset);
  }
  [[noreturn]] void fail(std::string_view key, const std::string& problem) override { file_.fail(at(key), problem); }

 private:
  [[nodiscard]] std::string at(std::string_view key) const { return table_ + "." + std::string(key); }
  TomlFile& file_;
  std::string table_;
};

}  // namespace feedtwin::tools
