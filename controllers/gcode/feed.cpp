#include "controllers/gcode/feed.h"

#include <numbers>

namespace feedtwin::controllers::gcode {
namespace {

constexpr double largest_feed_m_per_s = 1e4;

}  // namespace

void Feed::read(const Block& block, const Codes& codes, double unit_m) {
  if (const auto& code = codes[GGroup::feed_mode]) {
    mode_ = code->tenths == 930 ? Mode::inverse_time : code->tenths == 940 ? Mode::per_minute : Mode::per_revolution;
    value_ = 0.0;  // a feed of the other kind means nothing in this one
  }
  if (const auto& f = block.word('f')) {
    if (f->value < 0.0) block.fail(f->at, "expected a feed from 0 up");
    // lengths are in the units in force before this line's G20 or G21 (NISTIR 6556, table 8: F comes first)
    value_ = mode_ == Mode::inverse_time ? f->value : f->value * unit_m;
  }
}

double Feed::m_per_s(const Block& block, double length_m, double spindle_rad_per_s) const {
  if (mode_ == Mode::inverse_time && !block.word('f')) block.fail(0, "G93 asks for an F word on every line that feeds");
  if (value_ <= 0.0) block.fail(0, "a feed move without a feed (F)");
  double feed = 0.0;
  if (mode_ == Mode::inverse_time) {
    feed = length_m * value_ / 60.0;
  } else if (mode_ == Mode::per_minute) {
    feed = value_ / 60.0;
  } else {
    if (spindle_rad_per_s <= 0.0) block.fail(0, "a feed per revolution without a spindle speed (S)");
    feed = value_ * spindle_rad_per_s / (2.0 * std::numbers::pi);
  }
  const auto& f = block.word('f');
  if (!(feed <= largest_feed_m_per_s)) block.fail(f ? f->at : 0, "the feed is beyond any machine");
  return feed;
}

}  // namespace feedtwin::controllers::gcode
