#include "tools/config/toml_file.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "tools/config/input_error.h"
#include "tools/config/whole_file.h"

namespace feedtwin::tools {

struct TomlFile::Content {
  std::string path;
  toml::table root;
  std::set<std::string, std::less<>> asked;

  [[nodiscard]] const toml::node* find(std::string_view key) const { return root.at_path(key).node(); }
  const toml::node* ask(std::string_view key) {
    asked.emplace(key);
    return find(key);
  }
};

namespace {

std::string shown(const toml::node& node) {
  std::ostringstream out;
  node.visit([&out](const auto& value) {
    if constexpr (toml::is_table<decltype(value)>) {
      out << "a table";
    } else if constexpr (toml::is_array<decltype(value)>) {
      out << "an array";
    } else if constexpr (toml::is_string<decltype(value)>) {
      out << '"' << value.get() << '"';
    } else {
      out << value;
    }
  });
  return out.str();
}

/// Every value's path below a table, arrays of tables spelled out; an empty table's path ends with a dot.
void collect(const toml::node& node, const std::string& path, std::vector<std::string>& leaves) {
  if (const auto* table = node.as_table()) {
    if (table->empty() && !path.empty()) leaves.push_back(path + ".");
    for (const auto& [key, value] : *table) {
      collect(value, path.empty() ? std::string(key.str()) : path + "." + std::string(key.str()), leaves);
    }
  } else if (const auto* array = node.as_array(); array != nullptr && array->is_array_of_tables()) {
    for (std::size_t i = 0; i < array->size(); ++i) collect((*array)[i], fmt::format("{}[{}]", path, i), leaves);
  } else {
    leaves.push_back(path);
  }
}

}  // namespace

TomlFile::TomlFile() : content_(std::make_unique<Content>()) {}
TomlFile::TomlFile(TomlFile&&) noexcept = default;
TomlFile& TomlFile::operator=(TomlFile&&) noexcept = default;
TomlFile::~TomlFile() = default;

TomlFile TomlFile::read(const std::string& path) {
  return parse(read_whole_file(path), path);
}

TomlFile TomlFile::parse(std::string_view text, const std::string& name) {
  TomlFile file;
  file.content_->path = name;
  try {
    file.content_->root = toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error& error) {
    throw InputError(name, error.source().begin.line, "", fmt::format("not valid TOML: {}", error.description()));
  }
  return file;
}

const std::string& TomlFile::path() const noexcept {
  return content_->path;
}

bool TomlFile::has(std::string_view key) const {
  return content_->find(key) != nullptr;
}

void TomlFile::fail(std::string_view key, const std::string& problem) const {
  const auto* node = content_->find(key);
  throw InputError(content_->path, node == nullptr ? 0 : node->source().begin.line, std::string(key), problem);
}

std::optional<double> TomlFile::number(std::string_view key, double lowest, double highest) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value) || *value < lowest || *value > highest) {
    fail(key, fmt::format("expected a number from {:g} to {:g}, found {}", lowest, highest, shown(*node)));
  }
  return value;
}

double TomlFile::number(std::string_view key, double lowest, double highest, double preset) {
  return number(key, lowest, highest).value_or(preset);
}

double TomlFile::required_number(std::string_view key, double lowest, double highest) {
  const auto value = number(key, lowest, highest);
  if (!value) fail(key, fmt::format("missing; expected a number from {:g} to {:g}", lowest, highest));
  return *value;
}

std::optional<long long> TomlFile::integer(std::string_view key, long long lowest, long long highest) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->is_integer() ? node->value<long long>() : std::nullopt;
  if (!value || *value < lowest || *value > highest) {
    fail(key, fmt::format("expected a whole number from {} to {}, found {}", lowest, highest, shown(*node)));
  }
  return value;
}

long long TomlFile::integer(std::string_view key, long long lowest, long long highest, long long preset) {
  return integer(key, lowest, highest).value_or(preset);
}

bool TomlFile::boolean(std::string_view key, bool preset) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return preset;
  if (!node->is_boolean()) fail(key, fmt::format("expected true or false, found {}", shown(*node)));
  return node->value_or(preset);
}

std::optional<std::string> TomlFile::text(std::string_view key) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) fail(key, fmt::format("expected a text in quotes, found {}", shown(*node)));
  return node->value<std::string>();
}

std::string TomlFile::text(std::string_view key, const std::string& preset) {
  return text(key).value_or(preset);
}

std::string TomlFile::word(std::string_view key, const std::vector<std::string>& allowed, const std::string& preset) {
  const auto value = text(key);
  if (value && std::ranges::find(allowed, *value) == allowed.end()) {
    fail(key, fmt::format("expected one of {}, found \"{}\"", fmt::join(allowed, ", "), *value));
  }
  return value.value_or(preset);
}

std::vector<std::string> TomlFile::texts(std::string_view key) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return {};
  if (node->is_string()) return {*node->value<std::string>()};
  const auto* array = node->as_array();
  if (array == nullptr) fail(key, fmt::format("expected a list of texts, found {}", shown(*node)));
  std::vector<std::string> values;
  for (const auto& element : *array) {
    if (!element.is_string()) fail(key, fmt::format("expected a list of texts, found {} in it", shown(element)));
    values.push_back(*element.value<std::string>());
  }
  return values;
}

std::vector<double> TomlFile::numbers(std::string_view key, double lowest, double highest) {
  const auto* node = content_->ask(key);
  if (node == nullptr) return {};
  const auto* array = node->as_array();
  if (array == nullptr) fail(key, fmt::format("expected a list of numbers, found {}", shown(*node)));
  std::vector<double> values;
  for (const auto& element : *array) {
    const auto value = element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < lowest || *value > highest) {
      fail(key, fmt::format("expected numbers from {:g} to {:g}, found {} in it", lowest, highest, shown(element)));
    }
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string> TomlFile::names_in(std::string_view table) const {
  std::vector<std::string> names;
  const auto* node = content_->find(table);
  if (node == nullptr) return names;
  if (!node->is_table()) fail(table, fmt::format("expected a table, found {}", shown(*node)));
  for (const auto& [key, value] : *node->as_table()) names.emplace_back(key.str());
  return names;
}

std::size_t TomlFile::tables_in(std::string_view key) const {
  const auto* node = content_->find(key);
  if (node == nullptr || node->is_table()) return 0;
  const auto* array = node->as_array();
  if (array == nullptr || !array->is_array_of_tables()) fail(key, "expected tables written as [[" + std::string(key) + "]]");
  return array->size();
}

void TomlFile::leave(std::string_view table) {
  std::vector<std::string> leaves;
  if (const auto* node = content_->find(table); node != nullptr && node->is_table())
    collect(*node, std::string(table), leaves);
  content_->asked.insert(leaves.begin(), leaves.end());
}

void TomlFile::reject_unknown() const {
  std::vector<std::string> leaves;
  collect(content_->root, "", leaves);
  std::string first;
  std::size_t first_line = 0;
  for (const auto& leaf : leaves) {
    const auto known = content_->asked.lower_bound(leaf);
    if (known != content_->asked.end() && (*known == leaf || (leaf.back() == '.' && known->starts_with(leaf)))) continue;
    const std::string key = leaf.back() == '.' ? leaf.substr(0, leaf.size() - 1) : leaf;
    const std::size_t line = content_->find(key)->source().begin.line;
    if (first.empty() || line < first_line) {
      first = key;
      first_line = line;
    }
  }
  if (!first.empty()) throw InputError(content_->path, first_line, first, "unknown key");
}

}  // namespace feedtwin::tools
