#include "tools/diagnose/forward/likeliest_start.h"

#include <algorithm>

#include "tools/diagnose/forward/extended_axis.h"
#include "tools/diagnose/forward/likelihood.h"

namespace feedtwin::tools::diagnosis {

Candidate at_likeliest_start(const ForwardModel& forward, Candidate model) {
  constexpr double by_much_nats = 100.0;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const auto& parameters = model.effects[e].hypothesis->parameters;
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      if (parameters[j].kind != Kind::simulated) continue;
      double most = likelihood(forward, extended(model)).total() + by_much_nats;
      Candidate other = model;
      const double start = model.effects[e].q[j];
      for (const double more : {1.5, 3.0}) {  // of a logarithm
        other.effects[e].q[j] = std::min(start + more, parameters[j].highest);
        const double nats = likelihood(forward, extended(other)).total();
        if (nats > most) most = nats, model = other;
      }
    }
  }
  return model;
}

}  // namespace feedtwin::tools::diagnosis
