// The interpreter survives any text: it gives finite canonical commands or a GcodeError that points into the text.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "controllers/gcode/interpreter.h"

namespace gcode = feedtwin::controllers::gcode;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const gcode::Point& p) {
  require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
}

void check(const gcode::Command& command) {
  if (const auto* t = std::get_if<gcode::StraightTraverse>(&command.action)) check(t->to_m);
  if (const auto* f = std::get_if<gcode::StraightFeed>(&command.action)) {
    check(f->to_m);
    require(std::isfinite(f->feed_m_per_s) && f->feed_m_per_s >= 0.0);
  }
  if (const auto* a = std::get_if<gcode::ArcFeed>(&command.action)) {
    check(a->to_m);
    check(a->centre_m);
    require(std::isfinite(a->sweep_rad) && a->sweep_rad != 0.0 && std::isfinite(a->feed_m_per_s) && a->feed_m_per_s > 0.0);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const gcode::Program program = gcode::interpret(text);
    require(!program.empty() && std::holds_alternative<gcode::ProgramEnd>(program.back().action));
    for (const auto& command : program) check(command);
  } catch (const gcode::GcodeError& error) {
    require(error.line() >= 1 && error.column() >= 1 && error.column() <= size + 1);
  }
  return 0;
}
