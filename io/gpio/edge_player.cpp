#include "io/gpio/edge_player.h"

#include <algorithm>

namespace feedtwin::io::gpio {

EdgePlayer::EdgePlayer(Lines& lines, const std::vector<EdgeAxis>& axes, std::int64_t tick_ns, std::int64_t spacing_ns)
    : lines_(lines), axes_(axes), faults_(axes.size()) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    schedules_.emplace_back(axes[i].start_count, tick_ns, spacing_ns);
    levels_ |= static_cast<std::uint64_t>(levels_at(axes[i].start_count, axes[i].counts_per_rev)) << (3 * i);
  }
}

void EdgePlayer::aim(std::size_t axis, std::int64_t counts, std::int64_t start_ns) noexcept {
  schedules_[axis].aim(counts - faults_[axis].lost_counts, start_ns);
}

void EdgePlayer::place(std::size_t axis, std::int64_t counts) noexcept {
  schedules_[axis].place(counts);
  std::uint64_t levels = levels_;
  put(axis, levels);
  out(levels);
}

/// The axis's levels at its present count, as its faults let them through.
void EdgePlayer::put(std::size_t axis, std::uint64_t& levels) const noexcept {
  const auto before = static_cast<std::uint8_t>(levels_ >> (3 * axis) & 7U);
  const auto after = faults_[axis].apply(levels_at(schedules_[axis].count(), axes_[axis].counts_per_rev), before);
  levels = (levels & ~(std::uint64_t{7} << (3 * axis))) | static_cast<std::uint64_t>(after) << (3 * axis);
}

void EdgePlayer::out(std::uint64_t levels) noexcept {
  if (levels == levels_) return;
  levels_ = levels;
  if (!lines_.set(levels)) ++refused_sets_;
}

std::int64_t EdgePlayer::next_ns() const noexcept {
  std::int64_t next = never;
  for (const auto& schedule : schedules_) {
    if (!schedule.idle()) next = std::min(next, schedule.due_ns());
  }
  return next;
}

void EdgePlayer::play(std::int64_t now_ns) noexcept {
  std::uint64_t levels = levels_;
  for (std::size_t i = 0; i < schedules_.size(); ++i) {
    auto& schedule = schedules_[i];
    if (schedule.idle() || schedule.due_ns() > now_ns) continue;
    most_late_ns_ = std::max(most_late_ns_, now_ns - schedule.due_ns());
    schedule.done(now_ns);
    put(i, levels);
  }
  out(levels);
}

}  // namespace feedtwin::io::gpio
