// Friction along the recorded runs, for several models at once.

#include <algorithm>
#include <memory>

#include "plant/axis_model.h"
#include "tools/diagnose/inverse_model.h"
#include "tools/diagnose/said.h"
#include "tools/identify/lanes/follow.h"
#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

/// Factors on friction along a run, by sample; empty where the effects leave friction alone.
struct Factors {
  Vector screw_sliding, screw_viscous, guide_sliding, guide_viscous;
  std::vector<Said> said;  ///< by effect, of a model that others stand beside
};

/// @param like a model beside this one, of which what says the same is taken; nullptr: all is asked
Factors factors_of(const InverseModel::Asked& model, const Track& track, const InverseModel::Asked* beside,
                   const Factors* like, const Alike& alike) {
  constexpr double least = 0.05;
  const Baseline none;
  const auto& effects = *model.effects;
  Contribution sum, on_table;
  const bool by_load = std::ranges::any_of(effects, [](const Active& a) { return a.hypothesis->by_load; });
  for (const auto& effect : effects)
    if (by_load && loads_table(*effect.hypothesis)) effect.hypothesis->apply({track, *model.axis, none}, effect.q, on_table);
  std::vector<Said> said(like == nullptr ? effects.size() : 0);
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!effects[e].hypothesis->friction) continue;
    if (like != nullptr && effects[e].q == (*beside->effects)[e].q && says_the_same(like->said[e].seen, alike)) {
      add(sum, like->said[e].adds);
      continue;
    }
    Said own = said_by(effects[e], {track, *model.axis, none, &on_table});
    add(sum, own.adds);
    if (like == nullptr) said[e] = std::move(own);
  }
  return {sum.screw_sliding.cwiseMax(least), sum.screw_viscous.cwiseMax(least), sum.guide_sliding.cwiseMax(least),
          sum.guide_viscous.cwiseMax(least), std::move(said)};
}

/// What laws of friction look at: the contacts, the table's mass and how the axis is built.
Alike in_common(const InverseModel::Asked& one, const InverseModel::Asked& other) {
  const auto &a = *one.axis, &b = *other.axis;
  Alike alike{.transmission = a.axis == b.axis, .ball_screw = a.ball_screw == b.ball_screw};
  alike.axis = alike.transmission && alike.ball_screw && a.guide == b.guide && a.guide_mass_kg == b.guide_mass_kg;
  alike.on_table = alike.axis && std::ranges::equal(*one.effects, *other.effects, [&](const Active& p, const Active& q) {
                     return p.q == q.q || !loads_table(*p.hypothesis);
                   });
  alike.base = true;  // none is given
  return alike;
}

bool same_factors(const InverseModel::Asked& one, const InverseModel::Asked& other, const std::vector<Factors>& said,
                  const Alike& alike) {
  for (std::size_t e = 0; e < one.effects->size(); ++e) {
    if (!(*one.effects)[e].hypothesis->friction) continue;
    if ((*one.effects)[e].q != (*other.effects)[e].q) return false;
    for (const auto& run : said)
      if (!says_the_same(run.said[e].seen, alike)) return false;
  }
  return true;
}

/// By model and run; mostly those of the first model.
std::vector<std::shared_ptr<const std::vector<Factors>>> all_factors(const std::vector<InverseModel::Asked>& models,
                                                                     const std::vector<Track>& tracks) {
  const auto& first = models.front();
  const auto of_first = std::make_shared<std::vector<Factors>>(tracks.size());
  parallel_for(tracks.size(),
               [&](std::size_t run) { (*of_first)[run] = factors_of(first, tracks[run], nullptr, nullptr, {}); });
  std::vector<std::shared_ptr<const std::vector<Factors>>> factors(models.size(), of_first);
  parallel_for(models.size(), [&](std::size_t m) {
    const Alike alike = in_common(first, models[m]);
    if (m == 0 || same_factors(first, models[m], *of_first, alike)) return;
    auto own = std::make_shared<std::vector<Factors>>();
    for (std::size_t run = 0; run < tracks.size(); ++run)
      own->push_back(factors_of(models[m], tracks[run], &first, &(*of_first)[run], alike));
    factors[m] = std::move(own);
  });
  return factors;
}

const double* data_or_none(const Vector& values) {
  return values.size() > 0 ? values.data() : nullptr;
}

}  // namespace

std::vector<std::vector<ContactForces>> InverseModel::contacts(const std::vector<Asked>& models) const {
  const std::size_t runs = tracks_.size();
  std::vector<std::vector<ContactForces>> forces(models.size(), std::vector<ContactForces>(runs));
  std::vector<plant::Contacts<double>> laws;
  for (const auto& model : models) laws.push_back(plant::make_axis_model(*model.axis).contacts);
  const auto factors = all_factors(models, tracks_);
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
                         data_or_none(scale.screw_sliding), data_or_none(scale.screw_viscous),
                         data_or_none(scale.guide_sliding), data_or_none(scale.guide_viscous), out.screw_N.data(),
                         out.guide_N.data()});
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
