#include "tools/config/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

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
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace feedtwin::tools
