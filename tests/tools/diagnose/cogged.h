#pragma once
// Runs with cogging and both engines on them: what a judgement about names starts from.

#include <functional>
#include <string_view>

#include "tests/support/made_case.h"
#include "tools/diagnose/forward/forward_model.h"

namespace feedtwin::tests {

inline const std::function<void(std::string_view)> silent = [](std::string_view) {};

/// Runs of the source's axis with cogging that the nominal axis does not have.
struct Cogged {
  tools::Case data;
  tools::diagnosis::InverseModel model;
  tools::diagnosis::Fitter fitter;
  tools::diagnosis::ForwardModel forward;
  tools::diagnosis::Candidate nominal;
  tools::diagnosis::Whitening whitening;

  Cogged()
      : data(made_runs()),
        model(tools::diagnosis::make_tracks(data.fit, data.axis), data.axis),
        fitter(model, data.axis),
        forward(data.fit, data),
        nominal{data.axis, {}},
        whitening(fitter.colour_of(model.residual(data.axis, {}))) {}

  static tools::Case made_runs() {
    auto truth = plant::source_axis();
    truth.effects.push_back(tests::effect("cogging", {{"amplitude_Nm", 0.01}, {"cycles_per_rev", 8.0}}));
    return tests::short_case(truth, plant::source_axis());
  }
};

}  // namespace feedtwin::tests
