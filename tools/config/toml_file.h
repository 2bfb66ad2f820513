#pragma once
// A TOML file whose every key is asked for once, with its type and range; what nobody asked for is an error.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace feedtwin::tools {

class TomlFile {
 public:
  /// Throws InputError when the file can't be read or is not TOML.
  static TomlFile read(const std::string& path);
  /// The same from text; `name` stands for the file in messages.
  static TomlFile parse(std::string_view text, const std::string& name);

  TomlFile(TomlFile&&) noexcept;
  TomlFile& operator=(TomlFile&&) noexcept;
  ~TomlFile();

  [[nodiscard]] const std::string& path() const noexcept;
  /// Keys are dotted paths ("motor.inertia_kgm2"). Each getter throws InputError on a wrong type or value.
  [[nodiscard]] bool has(std::string_view key) const;
  std::optional<double> number(std::string_view key, double lowest, double highest);
  double number(std::string_view key, double lowest, double highest, double preset);
  double required_number(std::string_view key, double lowest, double highest);
  std::optional<long long> integer(std::string_view key, long long lowest, long long highest);
  long long integer(std::string_view key, long long lowest, long long highest, long long preset);
  bool boolean(std::string_view key, bool preset);
  std::optional<std::string> text(std::string_view key);
  std::string text(std::string_view key, const std::string& preset);
  /// One of the allowed words.
  std::string word(std::string_view key, const std::vector<std::string>& allowed, const std::string& preset);
  /// An array of strings, or a single string; empty where the key is missing.
  std::vector<std::string> texts(std::string_view key);
  std::vector<double> numbers(std::string_view key, double lowest, double highest);
  /// The names of the entries of a table ("effects" -> {"cogging", ...}); empty where it is missing.
  [[nodiscard]] std::vector<std::string> names_in(std::string_view table) const;
  /// How many entries an array of tables has, 0 for a plain table; they are then addressed as "fault[0].at_s".
  [[nodiscard]] std::size_t tables_in(std::string_view key) const;

  /// A table that is somebody else's: nobody asks for its keys, and none is an error.
  void leave(std::string_view table);
  /// Throws InputError for the first key that was never asked for. Call it last.
  void reject_unknown() const;
  /// An error about a key of this file, with its line.
  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

 private:
  TomlFile();
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace feedtwin::tools
