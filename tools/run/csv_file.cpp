#include "tools/run/csv_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tools/config/input_error.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t flush_bytes = 64 * 1024;

}  // namespace

CsvFile::CsvFile(std::string path, std::string_view header) : path_(std::move(path)) {
  fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd_ < 0) throw InputError(path_, 0, "", std::string("log cannot be written: ") + std::strerror(errno));
  add(header);
  pending_rows_ = 0;
  flush();
}

CsvFile::~CsvFile() {
  flush();
  ::close(fd_);
}

void CsvFile::add(std::string_view row) {
  pending_.append(row);
  pending_.push_back('\n');
  ++pending_rows_;
  if (pending_.size() >= flush_bytes) flush();
}

void CsvFile::flush() noexcept {
  const char* data = pending_.data();
  std::size_t left = pending_.size();
  const off_t start = ::lseek(fd_, 0, SEEK_CUR);
  while (left > 0) {
    const ssize_t written = ::write(fd_, data, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      // disk full: take back what is not whole, so that the file ends with a row, and count what is lost
      if (start >= 0 && ::ftruncate(fd_, start) == 0) ::lseek(fd_, start, SEEK_SET);
      unwritten_rows_ += pending_rows_;
      break;
    }
    data += written;
    left -= static_cast<std::size_t>(written);
  }
  pending_.clear();
  pending_rows_ = 0;
}

}  // namespace feedtwin::tools
