#include "tests/bench/methods/other_methods.h"

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>

namespace feedtwin::bench {
namespace {

namespace odeint = boost::numeric::odeint;
using golden::FeedDrive;
using golden::Mode;
using golden::State;
using golden::velocity;

Mode mode_of(const FeedDrive& drive, const State& y, double force_N) {
  if (y[velocity] > 0.0) return Mode::forward;
  return y[velocity] < 0.0 ? Mode::backward : golden::mode_from_rest(drive, y, force_N);
}

bool crossed(Mode mode, double v) {
  return mode == Mode::forward ? v < 0.0 : v > 0.0;
}

/// Advances y to the tick's end; `step(mode, y, t, h)` takes an accepted step of at most h and moves y, t and h.
template <class Step>
void advance(const FeedDrive& drive, State& y, double force_N, double tick_s, double& step_s, Step&& step) {
  double t = 0.0;
  while (tick_s - t > 1e-12) {
    const Mode mode = mode_of(drive, y, force_N);
    if (mode == Mode::stuck) {
      y[golden::electrical_loss] += drive.ke0_W * (tick_s - t);
      return;
    }
    const State before = y;
    const double from = t;
    double h = std::min(step_s, tick_s - t);
    const bool cut = h < step_s;
    step(mode, y, t, h);
    if (!cut || h < step_s) step_s = h;
    if (!crossed(mode, y[velocity])) continue;
    // once more, to where the velocity vanishes on the line between the two ends
    const double v0 = before[velocity];
    double part = (t - from) * v0 / (v0 - y[velocity]);
    if (v0 == 0.0) part = 1e-9;
    y = before;
    t = from;
    const double until = from + part;
    while (until - t > 1e-15) {
      h = until - t;
      step(mode, y, t, h);
    }
    y[velocity] = 0.0;
  }
}

}  // namespace

void DormandPrinceAxis::tick(double force_N, double tick_s) {
  auto stepper = odeint::make_controlled(tolerance_ * 1e-6, tolerance_, odeint::runge_kutta_dopri5<State>());
  advance(drive_, y_, force_N, tick_s, step_s_, [&](Mode mode, State& y, double& t, double& h) {
    const auto system = [&](const State& at, State& dy, double) {
      golden::derivative(drive_, mode, force_N, at.data(), dy.data());
    };
    stepper.reset();
    const double most = h;
    do {
      h = std::min(h, most);
    } while (stepper.try_step(system, y, t, h) != odeint::success);
  });
}

void RosenbrockAxis::tick(double force_N, double tick_s) {
  using Vector = boost::numeric::ublas::vector<double>;
  using Matrix = boost::numeric::ublas::matrix<double>;
  auto stepper = odeint::make_controlled(tolerance_ * 1e-6, tolerance_, odeint::rosenbrock4<double>());
  Vector vector(golden::unknowns);
  advance(drive_, y_, force_N, tick_s, step_s_, [&](Mode mode, State& y, double& t, double& h) {
    const auto system = [&](const Vector& at, Vector& dy, double) {
      golden::derivative(drive_, mode, force_N, &at[0], &dy[0]);
    };
    const auto jacobian = [&](const Vector& at, Matrix& j, double, Vector& dfdt) {
      State y0, f0, f1;
      std::copy(at.begin(), at.end(), y0.begin());
      golden::derivative(drive_, mode, force_N, y0.data(), f0.data());
      j.clear();
      dfdt.clear();
      constexpr std::array scale = {1e-2, 1e-6, 1e-5};
      for (std::size_t c = 0; c < 3; ++c) {
        State moved = y0;
        const double d = 1e-7 * (std::abs(y0[velocity + c]) + scale[c]);
        moved[velocity + c] += d;
        golden::derivative(drive_, mode, force_N, moved.data(), f1.data());
        for (std::size_t r = 0; r < golden::unknowns; ++r) j(r, velocity + c) = (f1[r] - f0[r]) / d;
      }
    };
    std::copy(y.begin(), y.end(), vector.begin());
    const double most = h;
    do {
      h = std::min(h, most);
    } while (stepper.try_step(std::make_pair(system, jacobian), vector, t, h) != odeint::success);
    std::copy(vector.begin(), vector.end(), y.begin());
  });
}

void EulerAxis::tick(double force_N, double tick_s) {
  double step_s = tick_s / steps_;
  const double fixed_s = step_s;
  advance(drive_, y_, force_N, tick_s, step_s, [&](Mode mode, State& y, double& t, double& h) {
    State dy;
    golden::derivative(drive_, mode, force_N, y.data(), dy.data());
    for (std::size_t i = 0; i < golden::unknowns; ++i) y[i] += h * dy[i];
    t += h;
    h = fixed_s;
  });
}

}  // namespace feedtwin::bench
