#pragma once
// The last word on the numbers of a named model: output error of the forward closed-loop simulation, with the nominal
// numbers under their prior and the effects' own free, started from what the inverse model found.

#include "tools/diagnose/forward/forward_model.h"
#include "tools/diagnose/forward/slopes.h"
#include "tools/identify/output_error.h"

namespace feedtwin::tools::diagnosis {

struct Polished {
  Candidate model;
  /// Of the base parameters (in tolerances) and then the effects' working parameters that are not fixed: as Fit has it.
  Eigen::MatrixXd covariance;
  double cost = 0.0;
  bool moved = true;  ///< false: the start's numbers are as good as it gets
};

struct PolishSettings {
  int rounds = 2, most_iterations = 4;
  double least_fall_nats = 0.5;  ///< what a number costs that is off by its own deviation; the last step is taken
  bool coloured_from_start = false, intervals = true;
  const Slopes* known = nullptr;     ///< not seen anew: of the nominal model's numbers,
  std::size_t known_effects = 0;     ///< and of the numbers of so many effects, the first
  bool known_to_begin_with = false;  ///< in the first of several rounds only
  Slopes* learned = nullptr;         ///< takes the slopes that this polish sees, the last of them
  double behind_nats = 0.0;          ///< another model is ahead by so many: see LeastSquaresProblem
  double least_promise_nats = 0.0;   ///< of the last effect, by straight slopes: where it is less, the start stays as it is
};

[[nodiscard]] Polished polish(const ForwardModel& forward, const Fitter& fitter, const Candidate& start,
                              const PolishSettings& settings = {});

}  // namespace feedtwin::tools::diagnosis
