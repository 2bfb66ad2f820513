#include "tools/run/run_log.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <chrono>
#include <filesystem>

#include "tools/config/input_error.h"
#include "tools/machine/machine_recording.h"
#include "tools/run/csv_file.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t ticks_before_late = 100, ticks_after_late = 20;
constexpr std::uint64_t most_late_dumps = 50;  // then the file would only grow
constexpr std::uint64_t most_events_on_terminal = 20;

std::string with_suffix(const std::string& path, const std::string& suffix) {
  std::filesystem::path changed(path);
  changed.replace_extension(suffix);
  return changed.string();
}

std::string_view state_name(io::DriveState state) noexcept {
  switch (state) {
    case io::DriveState::disabled:
      return "disabled";
    case io::DriveState::enabled:
      return "enabled";
    case io::DriveState::quick_stop:
      return "quick-stop";
    case io::DriveState::fault:
      return "fault";
  }
  return "";
}

std::string header(const RunLogSettings& settings) {
  std::string columns = "time_s,torque_cmd_Nm,position_m,scale_position_m,";
  if (settings.with_forces) columns += "torque_sensor_Nm,force_sensor_N,";
  columns += "power_W,";
  if (settings.reference_m) columns += "reference_m,";
  return columns + "lateness_us,work_us,input_age_us,drive_state";
}

std::shared_ptr<spdlog::logger> make_event_log(const std::string& path) {
  auto terminal = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
  terminal->set_level(spdlog::level::warn);
  std::vector<spdlog::sink_ptr> sinks{terminal};
  if (!path.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(with_suffix(path, ".events.log"), true));
    } catch (const spdlog::spdlog_ex& error) {
      throw InputError(with_suffix(path, ".events.log"), 0, "", std::string("log cannot be written: ") + error.what());
    }
  }
  auto logger = std::make_shared<spdlog::logger>("events", sinks.begin(), sinks.end());
  logger->set_pattern("%H:%M:%S.%e %v");
  return logger;
}

bool is_warning(rt::EventKind kind) noexcept {
  return kind != rt::EventKind::enabled && kind != rt::EventKind::disabled && kind != rt::EventKind::late_tick &&
         kind != rt::EventKind::fault_cleared;
}

}  // namespace

std::string recording_path(const std::string& path, std::size_t axis, std::size_t axes) {
  return axes == 1 ? path : with_suffix(path, fmt::format(".axis{}.csv", axis));
}

RunLog::RunLog(const RunLogSettings& settings) : settings_(settings), batch_(4096) {
  const std::size_t axes = settings.m_per_count.size();
  if (!settings.path.empty()) {
    for (std::size_t i = 0; i < axes; ++i) {
      files_.push_back(std::make_unique<CsvFile>(recording_path(settings.path, i, axes), header(settings)));
    }
  }
  if (settings.machine != nullptr && !settings.path.empty())
    machine_file_ = std::make_unique<CsvFile>(settings.path, machine_columns());
  events_ = make_event_log(settings.path);
}

RunLog::~RunLog() {
  finish();
}

std::uint64_t RunLog::unwritten_rows() const noexcept {
  std::uint64_t rows = 0;
  for (const auto& file : files_) rows += file->unwritten_rows();
  if (machine_file_) rows += machine_file_->unwritten_rows();
  return rows;
}

std::vector<std::string> RunLog::paths() const {
  std::vector<std::string> paths;
  if (machine_file_) paths.push_back(machine_file_->path());
  for (const auto& file : files_) paths.push_back(file->path());
  if (late_file_) paths.push_back(late_file_->path());
  return paths;
}

void RunLog::start(rt::PlantLoop& loop) {
  thread_ = std::thread([this, &loop] {
    auto last_flush = std::chrono::steady_clock::now();
    while (!finish_.load(std::memory_order_acquire)) {
      drain(loop);
      const auto now = std::chrono::steady_clock::now();
      if (now - last_flush > std::chrono::milliseconds(250)) {
        for (const auto& file : files_) file->flush();
        if (machine_file_) machine_file_->flush();
        events_->flush();
        last_flush = now;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    drain(loop);
  });
}

void RunLog::finish() {
  finish_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
  for (const auto& file : files_) file->flush();
  if (machine_file_) machine_file_->flush();
  if (late_file_) late_file_->flush();
  events_->flush();
}

void RunLog::drain(rt::PlantLoop& loop) {
  for (std::size_t count = loop.records().pop(batch_); count > 0; count = loop.records().pop(batch_)) {
    for (std::size_t i = 0; i < count; ++i) {
      write_row(batch_[i]);
      keep_for_late_ticks(batch_[i]);
    }
    rows_ += count;
  }
  drain_machine();
  std::array<rt::Event, 64> events;
  for (std::size_t count = loop.events().pop(events); count > 0; count = loop.events().pop(events)) {
    for (std::size_t i = 0; i < count; ++i) write_event(events[i]);
  }
}

void RunLog::drain_machine() {
  if (settings_.machine == nullptr) return;
  std::array<rt::MachineRecord, 256> rows;
  auto& ring = settings_.machine->records();
  for (std::size_t count = ring.pop(rows); count > 0; count = ring.pop(rows)) {
    for (std::size_t i = 0; machine_file_ && i < count; ++i) machine_file_->add(machine_row(rows[i]));
  }
}

void RunLog::write_row(const rt::AxisRecord& row) {
  if (files_.empty()) return;
  const auto axis = static_cast<std::size_t>(row.axis);
  fmt::memory_buffer line;
  auto out = std::back_inserter(line);
  fmt::format_to(out, "{:.6f},{:.9f},{:.10f},{:.10f},", static_cast<double>(row.tick) * settings_.tick_s,
                 row.torque_command_Nm, static_cast<double>(row.encoder_counts) * settings_.m_per_count[axis],
                 row.scale_position_m);
  if (settings_.with_forces) fmt::format_to(out, "{:.6f},{:.4f},", row.torque_sensor_Nm, row.force_sensor_N);
  fmt::format_to(out, "{:.4f},", row.metered_power_W);
  if (settings_.reference_m) fmt::format_to(out, "{:.10f},", settings_.reference_m(axis, row.tick));
  fmt::format_to(out, "{:.1f},{:.1f},{:.1f},{}", row.lateness_us, row.work_us, row.input_age_us, state_name(row.state));
  files_[axis]->add({line.data(), line.size()});
}

void RunLog::keep_for_late_ticks(const rt::AxisRecord& row) {
  if (settings_.path.empty() || row.axis != 0) return;
  const auto write = [this](const rt::AxisRecord& r) {
    late_file_->add(fmt::format("{},{:.1f},{:.1f},{:.1f}", r.tick, r.lateness_us, r.work_us, r.input_age_us));
  };
  const bool late = row.lateness_us > settings_.late_us;
  if (late && row.tick >= late_dump_until_ && late_dumps_ < most_late_dumps) {
    if (!late_file_) {
      late_file_ =
          std::make_unique<CsvFile>(with_suffix(settings_.path, ".late.csv"), "tick,lateness_us,work_us,input_age_us");
    }
    ++late_dumps_;
    for (const auto& before : recent_) write(before);
    recent_.clear();
    late_dump_until_ = row.tick + ticks_after_late;
  }
  if (row.tick < late_dump_until_) {
    write(row);
    return;
  }
  recent_.push_back(row);
  if (recent_.size() > ticks_before_late) recent_.pop_front();
}

void RunLog::note(double time_s, const std::string& text) {
  events_->info("{:.3f} s {}", time_s, text);
}

void RunLog::write_event(const rt::Event& event) {
  const std::string what = fmt::format(fmt::runtime(rt::meaning(event.kind)), event.value);
  const std::string where = event.axis >= 0 ? fmt::format("axis {}: ", event.axis) : "";
  const bool warning = is_warning(event.kind) && ++events_written_ <= most_events_on_terminal;
  events_->log(warning ? spdlog::level::warn : spdlog::level::info, "{:.3f} s {}{}",
               static_cast<double>(event.tick) * settings_.tick_s, where, what);
}

}  // namespace feedtwin::tools
