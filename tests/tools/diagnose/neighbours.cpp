// A Jacobian's columns ask only what is another's beside the model: they must be what asking everything anew gives.

#include "tools/diagnose/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/made_case.h"
#include "tools/diagnose/base_parameters.h"
#include "tools/diagnose/fit.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

/// Laws that look at the model in different ways: at nothing, the screw, all numbers, its forces, the table's other loads.
constexpr std::array lawful{"gravity",
                            "thermal_friction",
                            "load_dependent_friction",
                            "sensor_gain",
                            "encoder_eccentricity",
                            "sublinear_viscous",
                            "friction_drift",
                            "payload",
                            "regeneration_clipped",
                            "position_friction",
                            "copper_loss",
                            "hidden_friction_compensation"};

class NeighboursOfRandomModels : public testing::TestWithParam<unsigned> {
 protected:
  NeighboursOfRandomModels() : model_(make_tracks(runs(), plant::source_axis()), plant::source_axis()) {
    at_.axis = plant::source_axis();
    std::array<std::string_view, lawful.size()> ids{};
    std::ranges::copy(lawful, ids.begin());
    std::ranges::shuffle(ids, random_);
    for (const auto id : std::span(ids).first(4)) at_.effects.push_back(drawn(hypothesis(id)));
  }

  static std::vector<tools::Recording> runs() {
    std::vector<tools::Recording> made;
    for (const char* motion : {"sine", "triangle"})
      made.push_back(tests::make_recording(plant::source_axis(), {.motion = motion, .duration_s = 1.0}));
    return made;
  }

  Active drawn(const Hypothesis& h) {
    Active effect{&h, {}};
    const std::vector<double> shape = h.shapes.empty() ? std::vector<double>{} : h.shapes.front();
    std::size_t next = 0;
    for (const auto& p : h.parameters) {
      const bool shaped = p.kind != Kind::amplitude && next < shape.size();
      const double value = shaped ? shape[next++] : std::uniform_real_distribution<double>(5.0, 50.0)(random_) * p.step;
      effect.q.push_back(std::clamp(value, p.lowest, p.highest));
    }
    return effect;
  }

  /// The model with one number changed, each in turn.
  std::vector<Candidate> beside() const {
    std::vector<Candidate> all;
    for (const auto& p : base_parameters(true)) {
      all.push_back(at_);
      set_value(p, all.back().axis, value_of(p, at_.axis) * 1.01);
    }
    for (std::size_t e = 0; e < at_.effects.size(); ++e)
      for (std::size_t j = 0; j < at_.effects[e].q.size(); ++j) {
        all.push_back(at_);
        all.back().effects[e].q[j] += at_.effects[e].hypothesis->parameters[j].step;
      }
    return all;
  }

  std::mt19937 random_{GetParam()};
  InverseModel model_;
  Candidate at_;
};

TEST_P(NeighboursOfRandomModels, FallAsTheWholeResidualDoes) {
  const auto contacts = model_.contacts(at_.axis, at_.effects);
  const Neighbours neighbours(model_, at_.axis, at_.effects, contacts);
  const Vector here = model_.residual(at_.axis, at_.effects);
  EXPECT_LT((neighbours.residual() - here).cwiseAbs().maxCoeff(), 1e-9 * here.cwiseAbs().maxCoeff());
  for (const auto& near : beside()) {
    const auto own = model_.contacts(near.axis, near.effects);
    const Vector whole = here - model_.residual(near.axis, near.effects);
    const Vector fall = neighbours.fall(near.axis, near.effects, own);
    EXPECT_LT((fall - whole).cwiseAbs().maxCoeff(), 1e-9 * here.cwiseAbs().maxCoeff() + 1e-6 * whole.cwiseAbs().maxCoeff());
  }
}

TEST_P(NeighboursOfRandomModels, OneMoreEffectFallsAsTheWholeResidualDoes) {
  const auto contacts = model_.contacts(at_.axis, at_.effects);
  const Vector here = model_.residual(at_.axis, at_.effects, contacts);
  const auto standing = model_.standing(at_.axis, model_.prepared(at_.axis, at_.effects, contacts), here);
  int asked = 0;
  for (const auto& hypothesis : hypotheses()) {
    if (hypothesis.friction || !gives_forces(hypothesis)) continue;
    const Active more = drawn(hypothesis);
    auto effects = at_.effects;
    effects.push_back(more);
    const Vector whole = here - model_.residual(at_.axis, effects, contacts);
    const Vector fall = model_.fall(standing, more);
    EXPECT_LT((fall - whole).cwiseAbs().maxCoeff(), 1e-9 * here.cwiseAbs().maxCoeff() + 1e-6 * whole.cwiseAbs().maxCoeff())
        << hypothesis.id;
    asked += whole.cwiseAbs().maxCoeff() > 0.0;
  }
  EXPECT_GT(asked, 20);
}

TEST_P(NeighboursOfRandomModels, FollowFrictionAsWhenAskedAlone) {
  const auto all = beside();
  std::vector<InverseModel::Asked> asked{{&at_.axis, &at_.effects}};
  for (const auto& near : all) asked.push_back({&near.axis, &near.effects});
  const auto together = model_.contacts(asked);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const auto alone = model_.contacts(all[m].axis, all[m].effects);
    for (std::size_t run = 0; run < alone.size(); ++run) {
      const double size = 1.0 + alone[run].screw_N.cwiseAbs().maxCoeff();
      EXPECT_LT((together[m + 1][run].screw_N - alone[run].screw_N).cwiseAbs().maxCoeff(), 1e-9 * size) << m;
      EXPECT_LT((together[m + 1][run].guide_N - alone[run].guide_N).cwiseAbs().maxCoeff(), 1e-9 * size) << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Diagnose, NeighboursOfRandomModels, testing::Range(0U, 8U));

}  // namespace
}  // namespace feedtwin
