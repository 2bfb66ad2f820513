// Friction along the recorded runs, for several models at once.

#include <algorithm>
#include <memory>

#include "plant/axis_model.h"
#include "tools/diagnose/inverse_model.h"
#include "tools/identify/lanes/follow.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Factors on friction along a run, by sample; empty where the effects leave friction alone.
struct Factors {
  Vector sliding, viscous;
};

Factors factors_of(const std::vector<Active>& effects, const plant::AxisParameters& axis, const Track& track) {
  constexpr double least = 0.05;
  const Baseline none;
  Contribution sum, on_table;
  const bool by_load = std::ranges::any_of(effects, [](const Active& a) { return a.hypothesis->by_load; });
  for (const auto& effect : effects)
    if (by_load && loads_table(*effect.hypothesis)) effect.hypothesis->apply({track, axis, none}, effect.q, on_table);
  for (const auto& effect : effects)
    if (effect.hypothesis->friction) effect.hypothesis->apply({track, axis, none, &on_table}, effect.q, sum);
  return {sum.screw_sliding.cwiseMax(least), sum.screw_viscous.cwiseMax(least)};
}

/// Do both models scale friction alike? Laws look at the contacts, the table's mass and how the axis is built.
bool alike(const InverseModel::Asked& one, const InverseModel::Asked& other) {
  const auto &a = *one.axis, &b = *other.axis;
  if (!(a.ball_screw == b.ball_screw && a.guide == b.guide && a.guide_mass_kg == b.guide_mass_kg && a.axis == b.axis))
    return false;
  return std::ranges::equal(*one.effects, *other.effects, [&](const Active& p, const Active& q) {
    return p.hypothesis == q.hypothesis && (p.q == q.q || !moves_friction(*p.hypothesis, *one.effects));
  });
}

const double* data_or_none(const Vector& values) {
  return values.size() > 0 ? values.data() : nullptr;
}

}  // namespace

std::vector<std::vector<ContactForces>> InverseModel::contacts(const std::vector<Asked>& models) const {
  const std::size_t runs = tracks_.size();
  std::vector<std::vector<ContactForces>> forces(models.size(), std::vector<ContactForces>(runs));
  std::vector<plant::Contacts<double>> laws;
  std::vector<std::shared_ptr<const std::vector<Factors>>> factors;  // by run; mostly those of the first model
  for (const auto& model : models) {
    laws.push_back(plant::make_axis_model(*model.axis).contacts);
    if (!factors.empty() && alike(models.front(), model)) {
      factors.push_back(factors.front());
      continue;
    }
    auto own = std::make_shared<std::vector<Factors>>();
    for (const Track& track : tracks_) own->push_back(factors_of(*model.effects, *model.axis, track));
    factors.push_back(std::move(own));
  }
  std::vector<lanes::FollowedMotion> motions;
  for (std::size_t run = 0; run < runs; ++run) {  // lanes side by side read the same motion
    const Track& track = tracks_[run];
    const bool apart = track.slip_m.size() > 0 && track.force_sensor_N.size() > 0;
    for (std::size_t m = 0; m < models.size(); ++m) {
      auto& out = forces[m][run];
      out.screw_N.resize(track.size);
      out.guide_N.resize(track.size);
      const auto& scale = (*factors[m])[run];
      motions.push_back({&laws[m], static_cast<std::size_t>(track.size), path_substeps, track.sample_s / path_substeps,
                         track.path_m_per_s.data(), (apart ? track.table_path_m_per_s : track.path_m_per_s).data(),
                         data_or_none(scale.sliding), data_or_none(scale.viscous), out.screw_N.data(), out.guide_N.data()});
    }
  }
  lanes::follow_friction(motions);
  return forces;
}

std::vector<ContactForces> InverseModel::contacts(const plant::AxisParameters& axis,
                                                  const std::vector<Active>& effects) const {
  return std::move(contacts({{&axis, &effects}}).front());
}

}  // namespace feedtwin::tools::diagnosis
