#include "tools/diagnose/forward/slopes.h"

#include <algorithm>
#include <array>

#include "tools/parallel.h"

namespace feedtwin::tools::diagnosis {
namespace {

using Eigen::MatrixXd;

auto channels_of(auto& s) {
  return std::array{&s.torque_Nm, &s.position_m,       &s.torque_sensor_Nm, &s.force_sensor_N,
                    &s.power_W,   &s.scale_position_m, &s.instant_power_W};
}

/// base + factor * more, channel by channel
Simulated sum(const Simulated& base, double factor, const Simulated& more) {
  Simulated out = base;
  const auto to = channels_of(out);
  const auto from = channels_of(more);
  for (std::size_t c = 0; c < to.size(); ++c)
    for (std::size_t i = 0; i < to[c]->size(); ++i) (*to[c])[i] += factor * (*from[c])[i];
  return out;
}

Simulated slope(const Simulated& from, const Simulated& to, double step) {
  Simulated out = sum(to, -1.0, from);
  for (auto* channel : channels_of(out))
    for (double& value : *channel) value /= step;
  return out;
}

/// The point, then one a step beside it in each unknown.
bool are_forward_differences(const MatrixXd& points) {
  if (points.cols() != points.rows() + 1) return false;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::VectorXd step = points.col(i + 1) - points.col(0);
    if (step[i] == 0.0) return false;
    step[i] = 0.0;
    if (!step.isZero(0.0)) return false;
  }
  return true;
}

}  // namespace

void Slopes::learn(std::size_t run, const MatrixXd& points, const std::vector<Simulated>& simulated) {
  if (!are_forward_differences(points)) return;
  auto& known = by_run_[run];
  known.resize(static_cast<std::size_t>(points.rows()));
  parallel_for(known.size(), [&](std::size_t place) {
    const auto i = static_cast<Eigen::Index>(place);
    known[place] = slope(simulated.front(), simulated[place + 1], points(i, i + 1) - points(i, 0));
  });
}

std::vector<Simulated> Slopes::simulated(std::size_t run, const MatrixXd& points, Eigen::Index shared,
                                         const Simulator& simulate) const {
  const auto& known = by_run_[run];
  if (known.empty() || !are_forward_differences(points)) return simulate(points);
  shared = std::min(shared, static_cast<Eigen::Index>(known.size()));
  std::vector<Eigen::Index> asked{0};
  for (Eigen::Index i = shared; i < points.rows(); ++i) asked.push_back(i + 1);
  auto found = simulate(points(Eigen::all, asked));
  std::vector<Simulated> all(static_cast<std::size_t>(points.cols()));
  parallel_for(static_cast<std::size_t>(shared), [&](std::size_t place) {
    const auto i = static_cast<Eigen::Index>(place);
    all[place + 1] = sum(found.front(), points(i, i + 1) - points(i, 0), known[place]);
  });
  for (std::size_t a = 0; a < asked.size(); ++a) all[static_cast<std::size_t>(asked[a])] = std::move(found[a]);
  return all;
}

}  // namespace feedtwin::tools::diagnosis
