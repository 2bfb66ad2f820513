#pragma once
// All axes' edges in the order of their times, onto the lines: what the edge thread does, without the thread.

#include <cstdint>
#include <limits>
#include <vector>

#include "io/gpio/line_faults.h"
#include "io/gpio/lines.h"
#include "io/gpio/quadrature.h"

namespace feedtwin::io::gpio {

struct EdgeAxis {
  std::int64_t counts_per_rev = 65536;
  std::int64_t start_count = 0;
};

class EdgePlayer {
 public:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  /// @param lines three an axis: A, B, Z
  EdgePlayer(Lines& lines, const std::vector<EdgeAxis>& axes, std::int64_t tick_ns, std::int64_t spacing_ns);

  /// Set-up: opens the lines at the start counts; throws PortError.
  void open() { lines_.open(levels_); }
  /// Put an axis to where the plant is at first, without the way there.
  void place(std::size_t axis, std::int64_t counts) noexcept;

  void aim(std::size_t axis, std::int64_t counts, std::int64_t start_ns) noexcept;
  void set_faults(std::size_t axis, const LineFaults& faults) noexcept { faults_[axis] = faults; }
  /// When the next edge is due; `never` if there is none.
  [[nodiscard]] std::int64_t next_ns() const noexcept;
  /// Put out every edge that is due by now, one of each axis at most, in one bulk set. Bounded.
  void play(std::int64_t now_ns) noexcept;

  [[nodiscard]] const std::vector<EdgeSchedule>& schedules() const noexcept { return schedules_; }
  [[nodiscard]] std::uint64_t refused_sets() const noexcept { return refused_sets_; }
  [[nodiscard]] std::int64_t most_late_ns() const noexcept { return most_late_ns_; }

 private:
  void put(std::size_t axis, std::uint64_t& levels) const noexcept;
  void out(std::uint64_t levels) noexcept;

  Lines& lines_;
  std::vector<EdgeAxis> axes_;
  std::vector<EdgeSchedule> schedules_;
  std::vector<LineFaults> faults_;
  std::uint64_t levels_ = 0;
  std::uint64_t refused_sets_ = 0;
  std::int64_t most_late_ns_ = 0;
};

}  // namespace feedtwin::io::gpio
