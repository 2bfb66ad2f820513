#include "tools/diagnose/switching.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/diagnose/size_of_axis.h"
#include "tools/diagnose/steady_motion.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double block_s = 0.02;

struct Block {
  double force_N = 0.0, at_s = 0.0;
  bool forth = true, follows = false;  ///< the block before it in time
};

void gather_blocks(const Track& track, const Vector& left_N, std::vector<Block>& blocks) {
  const auto steadily = moves_steadily(track);
  const Index samples = std::max<Index>(1, std::lround(block_s / track.sample_s));
  bool follows = false;
  for (Index k = 0; k + samples <= track.size; k += samples) {
    const auto from = steadily.begin() + k;
    const bool steady = std::all_of(from, from + samples, [](bool one) { return one; });
    if (steady)
      blocks.push_back({left_N.segment(k, samples).mean(), static_cast<double>(k) * track.sample_s,
                        track.centred_m_per_s[k] > 0.0, follows});
    follows = steady;
  }
}

/// The two values that leave least, and what they leave, as a share of the square about the mean.
struct TwoValues {
  double low = 0.0, high = 0.0, left = 1.0;
  [[nodiscard]] bool is_high(double value) const { return value > 0.5 * (low + high); }
};

TwoValues two_values_of(std::vector<double> values) {
  std::ranges::sort(values);
  const auto size = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double y : values) sum += y, squares += y * y;
  const double all = squares - sum * sum / size;
  TwoValues best;
  double below = 0.0, most = 0.0;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    below += values[i];
    const double count = static_cast<double>(i + 1), low = below / count, high = (sum - below) / (size - count);
    const double between = count * (size - count) / size * (high - low) * (high - low);
    if (between > most) most = between, best = {low, high, 1.0 - between / std::max(all, 1e-300)};
  }
  return best;
}

/// Is it on and off whichever way the axis goes? Otherwise it is friction.
bool both_ways(const std::vector<Block>& blocks, const TwoValues& values) {
  constexpr double least = 0.05;
  for (const bool forth : {true, false}) {
    double high = 0.0, all = 0.0;
    for (const Block& b : blocks)
      if (b.forth == forth) all += 1.0, high += values.is_high(b.force_N) ? 1.0 : 0.0;
    if (std::min(high, all - high) <= least * all) return false;
  }
  return true;
}

/// @param least_N that a force is told from
std::optional<Switching> switching_in(const std::vector<Block>& blocks, double least_N) {
  constexpr std::size_t least_blocks = 100, least_switches = 8, least_blocks_a_switch = 4;
  constexpr double most_left = 0.15;
  if (blocks.size() < least_blocks) return std::nullopt;
  std::vector<double> forces_N;
  for (const Block& b : blocks) forces_N.push_back(b.force_N);
  const TwoValues values = two_values_of(std::move(forces_N));
  Switching found{values.high - values.low, 1.0 - values.left, 0, 1e300, 0.0};
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    if (!blocks[i].follows || values.is_high(blocks[i].force_N) == values.is_high(blocks[i - 1].force_N)) continue;
    ++found.switches;
    found.first_s = std::min(found.first_s, blocks[i].at_s), found.last_s = std::max(found.last_s, blocks[i].at_s);
  }
  const bool told = values.left < most_left && found.force_N > least_N && found.switches >= least_switches &&
                    least_blocks_a_switch * found.switches <= blocks.size() && both_ways(blocks, values);
  return told ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<Switching> switching_of(const InverseModel& model, const Candidate& at) {
  constexpr double least = 1.0;
  const double least_N = least * newton_of(model.nominal());
  const auto left_N = forces_left_N(model, at);
  std::vector<Block> blocks;
  for (std::size_t run = 0; run < left_N.size(); ++run) gather_blocks(model.tracks()[run], left_N[run], blocks);
  auto found = switching_in(blocks, least_N);
  if (found) return found;
  for (Block& b : blocks) b.force_N *= b.forth ? 1.0 : -1.0;
  found = switching_in(blocks, least_N);
  if (found) found->opposes = true;
  return found;
}

bool force_switches(const InverseModel& model, const Candidate& recalibrated, const Candidate& named) {
  return switching_of(model, recalibrated) && switching_of(model, named);
}

}  // namespace feedtwin::tools::diagnosis
