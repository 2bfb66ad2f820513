#include "tools/config/whole_file.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "tools/config/input_error.h"

namespace feedtwin::tools {

void write_whole_file(const std::string& path, std::string_view text) {
  const std::string partial = path + ".partial-" + std::to_string(::getpid());
  std::ofstream file(partial, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(partial, path, error);
  if (!file || error) {
    const std::string reason = error ? error.message() : std::strerror(errno);
    std::filesystem::remove(partial, error);
    throw InputError(path, 0, "", "cannot be written: " + reason);
  }
}

std::string read_whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw InputError(path, 0, "", "cannot be opened for reading");
  std::string text;
  std::error_code error;
  if (const auto size = std::filesystem::file_size(path, error); !error) text.reserve(size);  // pipes have none
  std::array<char, 1 << 16> part;
  while (file.read(part.data(), part.size()) || file.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace feedtwin::tools
