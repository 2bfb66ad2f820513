#pragma once
// The contact whose friction drifts, ages, warms up or varies along the stroke: the ball screw's, or on a direct drive,
// whose screw has hardly any friction, the guide's (axis.friction_laws_on_guide).

#include "plant/contacts.h"
#include "plant/parameters.h"

namespace feedtwin::plant::effects {

class LawContact {
 public:
  explicit LawContact(const AxisParameters& axis) : on_guide_(axis.laws_on_guide()) {}

  [[nodiscard]] double& sliding(FrictionScale<double>& scale) const noexcept {
    return on_guide_ ? scale.guide_sliding : scale.screw_sliding;
  }
  [[nodiscard]] double& viscous(FrictionScale<double>& scale) const noexcept {
    return on_guide_ ? scale.guide_viscous : scale.screw_viscous;
  }

 private:
  bool on_guide_;
};

}  // namespace feedtwin::plant::effects
