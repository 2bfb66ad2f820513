#include "tools/machine/reciprocation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "controllers/cascade.h"
#include "controllers/motion.h"
#include "plant/feed_axis.h"
#include "plant/parameter_table.h"
#include "tools/machine/job.h"

namespace feedtwin::tools {
namespace {

constexpr double tick_s = 1e-3, amplitude_m = 0.03;

std::array<double, 4> components_J(const plant::AxisEnergy& e) {
  return {e.motor_electrical_J, e.motor_mechanical_J, e.ball_screw_J, e.guide_J};
}

/// Mean power by component of the source's axis in this motion, over two periods after the first.
std::array<double, 4> power_W(std::string_view motion, double speed_m_per_s) {
  const auto& kinds = controllers::motion_kinds();
  const auto kind = std::ranges::find(kinds, motion, &controllers::MotionKind::name);
  controllers::MotionSettings settings;
  settings.amplitude_m = amplitude_m;
  settings.speed_m_per_s = speed_m_per_s;
  const auto reference = kind->make(settings);
  const double period_s = (motion == "sine" ? 2.0 * std::numbers::pi : 4.0) * amplitude_m / speed_m_per_s;
  const auto parameters = plant::source_axis();
  plant::FeedAxis axis(parameters);
  controllers::Cascade cascade(cascade_of({}, parameters));
  cascade.reset(0.0);
  const int first = static_cast<int>(period_s / tick_s), last = 3 * first;
  std::array<double, 4> before{};
  for (int i = 0; i < last; ++i) {
    if (i == first) before = components_J(axis.energy());
    const double position_m = axis.encoder().position_m(axis.signals().encoder_counts);
    axis.step({.torque_Nm = cascade.torque_Nm(reference->at(i * tick_s), position_m, tick_s)}, tick_s);
  }
  std::array<double, 4> power = components_J(axis.energy());
  for (std::size_t k = 0; k < 4; ++k) power[k] = (power[k] - before[k]) / ((last - first) * tick_s);
  return power;
}

}  // namespace

Reciprocation closest_reciprocation(std::string_view motion, const std::array<double, 4>& wanted_J) {
  Reciprocation best;
  double least = 1e300;
  for (int step = 8; step <= 48; ++step) {
    const double speed = 0.0025 * step;
    const auto power = power_W(motion, speed);
    double first = 0.0, second = 0.0;  // the duration that is best in relative terms
    for (std::size_t i = 0; i < 4; ++i) {
      first += power[i] / wanted_J[i];
      second += std::pow(power[i] / wanted_J[i], 2);
    }
    const double duration = first / second;
    double error = 0.0;
    for (std::size_t i = 0; i < 4; ++i) error += std::pow(duration * power[i] / wanted_J[i] - 1.0, 2);
    if (error >= least) continue;
    least = error;
    best.speed_m_per_s = speed;
    best.duration_s = duration;
    for (std::size_t i = 0; i < 4; ++i) best.energy_J[i] = duration * power[i];
  }
  return best;
}

}  // namespace feedtwin::tools
