// Reads gpio-sim's lines back through sysfs and writes down every change of the first three with its time: an independent
// witness of what the kernel has on them. Knows nothing of quadrature. Reads until SIGTERM: how long the server takes to
// start is the host's affair, and a witness that leaves early has not seen the end.
//   line_reader SYSFS_FOLDER OUTPUT

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace {

volatile std::sig_atomic_t told_to_end = 0;

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

int level(int file) {
  char text = '0';
  return pread(file, &text, 1, 0) == 1 && text == '1' ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string folder = argv[1];
  int lines[3];
  for (int i = 0; i < 3; ++i) {
    lines[i] = open((folder + "/sim_gpio" + std::to_string(i) + "/value").c_str(), O_RDONLY);
    if (lines[i] < 0) {
      std::perror(folder.c_str());
      return 2;
    }
  }
  struct Change {
    std::int64_t time_ns;
    int levels;
  };
  std::vector<Change> changes;
  changes.reserve(1'000'000);
  std::signal(SIGTERM, [](int) { told_to_end = 1; });
  int last = -1, before = -1;
  while (told_to_end == 0) {
    const std::int64_t at_ns = now_ns();
    const int levels = level(lines[0]) | level(lines[1]) << 1 | level(lines[2]) << 2;
    const bool steady = levels == before;  // read twice alike: no edge fell between the lines
    before = levels;
    if (!steady || levels == last) continue;
    changes.push_back({at_ns, levels});
    last = levels;
  }
  std::FILE* out = std::fopen(argv[2], "w");
  if (out == nullptr) return 2;
  for (const auto& change : changes) std::fprintf(out, "%lld %d\n", static_cast<long long>(change.time_ns), change.levels);
  std::fclose(out);
  return 0;
}
