#pragma once
// Recordings with the nominal numbers fitted to them: what a question about an effect starts from.

#include <vector>

#include "tools/diagnose/fit.h"

namespace feedtwin::tests {

struct FittedRuns {
  tools::diagnosis::InverseModel model;
  tools::diagnosis::Fitter fitter;
  tools::diagnosis::Whitening whitening;
  tools::diagnosis::Fit fit;

  FittedRuns(const std::vector<tools::Recording>& runs, const plant::AxisParameters& nominal, int colours = 3)
      : model(tools::diagnosis::make_tracks(runs, nominal), nominal),
        fitter(model, nominal),
        whitening(fitter.colour_of(model.residual(nominal, {}))),
        fit(fitter.fit_with_colour({nominal, {}}, whitening, colours, 6)) {}
  FittedRuns(const FittedRuns&) = delete;
  FittedRuns& operator=(const FittedRuns&) = delete;
};

}  // namespace feedtwin::tests
