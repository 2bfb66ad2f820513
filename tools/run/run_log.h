#pragma once
// The log of a run: every tick's row as a recording in CSV, events as lines of text, late ticks with the ticks around
// them. A thread of its own takes them from the loop's rings, so that the tick never waits for a disk.

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "rt/machine_plant.h"
#include "rt/plant_loop.h"

namespace spdlog {
class logger;
}

namespace feedtwin::tools {

struct RunLogSettings {
  std::string path;  ///< of the recording; empty: events to the terminal only
  double tick_s = 1e-3;
  double late_us = 500.0;
  bool with_forces = true;
  std::vector<double> m_per_count;                                          ///< one for each axis
  std::function<double(std::size_t axis, std::uint64_t tick)> reference_m;  ///< may be empty
  rt::MachinePlant* machine = nullptr;                                      ///< whose rows go to `path` itself
};

class CsvFile;

/// "run.csv" for one axis; "run.axis0.csv", "run.axis1.csv" for more.
[[nodiscard]] std::string recording_path(const std::string& path, std::size_t axis, std::size_t axes);

class RunLog {
 public:
  /// Opens the files; throws InputError when one can't be written.
  explicit RunLog(const RunLogSettings& settings);
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Start taking rows and events of a loop, on a thread.
  void start(rt::PlantLoop& loop);
  /// Take what is left and close the files. Safe to call twice.
  void finish();
  /// Take what is there now: for a loop that is run and drained by one thread.
  void drain(rt::PlantLoop& loop);

  /// Write down something that happened outside the tick. Any thread.
  void note(double time_s, const std::string& text);

  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::uint64_t unwritten_rows() const noexcept;
  [[nodiscard]] std::vector<std::string> paths() const;

 private:
  void write_row(const rt::AxisRecord& row);
  void drain_machine();
  void keep_for_late_ticks(const rt::AxisRecord& row);
  void write_event(const rt::Event& event);

  RunLogSettings settings_;
  std::vector<std::unique_ptr<CsvFile>> files_;
  std::unique_ptr<CsvFile> machine_file_;
  std::unique_ptr<CsvFile> late_file_;
  std::shared_ptr<spdlog::logger> events_;
  std::deque<rt::AxisRecord> recent_;
  std::uint64_t late_dump_until_ = 0, late_dumps_ = 0;
  std::vector<rt::AxisRecord> batch_;
  std::uint64_t rows_ = 0;
  std::uint64_t events_written_ = 0;
  std::atomic<bool> finish_{false};
  std::thread thread_;
};

}  // namespace feedtwin::tools
