#include "tools/diagnose/motor_friction.h"

#include <algorithm>

#include "plant/effects/motor_presliding.h"

namespace feedtwin::tools::diagnosis {
namespace {

const plant::EffectSetting* bristle_of(const plant::AxisParameters& axis) {
  const auto effect = std::ranges::find(axis.effects, plant::effects::motor_presliding.id, &plant::EffectSetting::id);
  return effect == axis.effects.end() ? nullptr : &*effect;
}

Vector at_once(const Track& track, const plant::AxisParameters& axis) {
  const auto forward = (track.velocity_m_per_s.array() > 0.0);
  const auto& coulomb_N = axis.motor.coulomb_N;
  return (forward.select(Eigen::ArrayXd::Constant(track.size, coulomb_N.pos), coulomb_N.neg) * track.motor_direction.array())
      .matrix();
}

Vector over_path(const Track& track, const plant::AxisParameters& axis, const plant::EffectSetting& setting) {
  plant::effects::MotorPresliding bristle({.axis = axis, .model = plant::make_axis_model(axis)}, setting);
  Vector friction_N(track.size);
  double sign = 0.0;
  for (Index k = 0; k < track.size; ++k) {
    const double v = track.steady_m_per_s[k];
    if (v != 0.0) sign = v < 0.0 ? -1.0 : 1.0;
    plant::EffectMotion along{};
    along.velocity_m_per_s = v, along.sign = sign, along.h_s = track.sample_s;
    friction_N[k] = bristle.load(along).force_N;
    bristle.advance(along);
  }
  return friction_N;
}

}  // namespace

double motor_presliding_m(const plant::AxisParameters& axis) {
  const auto* setting = bristle_of(axis);
  return setting == nullptr ? 0.0 : setting->values.front();
}

Vector motor_coulomb_N(const Track& track, const plant::AxisParameters& axis) {
  const auto* setting = bristle_of(axis);
  const bool sets_in = setting != nullptr && setting->values.front() > 0.0;
  return sets_in ? over_path(track, axis, *setting) : at_once(track, axis);
}

}  // namespace feedtwin::tools::diagnosis
