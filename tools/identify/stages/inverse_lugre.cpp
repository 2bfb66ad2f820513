#include "tools/identify/stages/inverse_lugre.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "plant/lanes.h"

namespace feedtwin::tools {
namespace {

using Lanes = plant::Doubles<2>;
using Vector3 = Eigen::Vector3d;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double difference_step = 1e-4;  // of the logarithms that are searched for

/// Bristle force in units of F_C, at the middle of each tick, and dz/dt there.
struct Bristle {
  std::vector<double> steady, share, force, rate;

  /// @param per_length sigma0 / F_C; @param rise F_S / F_C - 1
  void follow(const InverseLugre::Run& run, double per_length, double rise, double stribeck_m_per_s) {
    const std::size_t n = run.speed.size();
    for (auto* values : {&steady, &share, &force, &rate}) values->resize(n + 1);
    const double per_v = 1.0 / stribeck_m_per_s;
    for (std::size_t i = 0; i < n; i += 2) {  // two ticks a register; the last may stand alone
      const bool pair = i + 1 < n;
      const Lanes speed{run.speed[i], pair ? run.speed[i + 1] : 0.0};
      const Lanes travel{run.travel_m[i], pair ? run.travel_m[i + 1] : 0.0};
      const Lanes g = 1.0 + rise * plant::exp_of_minus<Lanes>(speed * per_v);
      const Lanes y = per_length * travel / g;
      const Lanes left = 1.0 / (1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0))));
      steady[i] = g[0], share[i] = left[0];
      steady[i + 1] = g[1], share[i + 1] = left[1];
    }
    double now = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double v = run.velocity[i], toward = v < 0.0 ? -steady[i] : steady[i];
      const double next = toward + (now - toward) * share[i];
      force[i] = 0.5 * (now + next);
      rate[i] = v - run.speed[i] * force[i] / steady[i];
      now = next;
    }
  }
};

/// What is searched for, as logarithms: positive by construction.
struct Shape {
  double per_length, rise, stribeck_m_per_s;
  explicit Shape(const Vector3& x) : per_length(std::exp(x[0])), rise(std::exp(x[1])), stribeck_m_per_s(std::exp(x[2])) {}
};

Vector5 regressors_of(const InverseLugre::Run& run, const Bristle& bristle, std::size_t i) {
  return {run.acceleration[i], bristle.force[i], bristle.rate[i], run.velocity[i], 1.0};
}

/// Residuals after the best five linear numbers, for TinySolver.
class Projected {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 3 };

  Projected(std::span<const InverseLugre::Run> runs, std::size_t samples) : runs_(runs), samples_(samples) {}
  // NOLINTNEXTLINE(readability-identifier-naming): the name that TinySolver asks for
  [[nodiscard]] int NumResiduals() const { return static_cast<int>(samples_); }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Vector3> x(parameters);
    Eigen::Map<Eigen::VectorXd> r(residuals, NumResiduals());
    solve(x, r);
    if (jacobian == nullptr) return r.allFinite();
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 3>> j(jacobian, NumResiduals(), 3);
    for (int i = 0; i < 3; ++i) {
      Vector3 beside = x;
      beside[i] += difference_step;
      moved_.resize(NumResiduals());
      solve(beside, moved_);
      j.col(i) = (moved_ - r) / difference_step;
    }
    return r.allFinite() && j.allFinite();
  }

  /// The five, and the residuals that they leave.
  template <class Residuals>
  Vector5 solve(const Vector3& x, Residuals&& residuals) const {
    const Shape shape(x);
    Matrix5 normal = Matrix5::Zero();
    Vector5 right = Vector5::Zero();
    bristles_.resize(runs_.size());
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      bristles_[k].follow(runs_[k], shape.per_length, shape.rise, shape.stribeck_m_per_s);
      for (std::size_t i = 0; i < runs_[k].speed.size(); ++i) {
        const Vector5 row = regressors_of(runs_[k], bristles_[k], i);
        normal.noalias() += row * row.transpose();
        right.noalias() += row * runs_[k].force_N[i];
      }
    }
    const Vector5 size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Matrix5 scaled = size.asDiagonal() * normal * size.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const Vector5 linear = size.cwiseProduct(scaled.ldlt().solve(size.cwiseProduct(right)));
    Eigen::Index at = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      for (std::size_t i = 0; i < runs_[k].speed.size(); ++i)
        residuals[at++] = regressors_of(runs_[k], bristles_[k], i).dot(linear) - runs_[k].force_N[i];
    }
    return linear;
  }

 private:
  std::span<const InverseLugre::Run> runs_;
  std::size_t samples_;
  mutable std::vector<Bristle> bristles_;
  mutable Eigen::VectorXd moved_;
};

}  // namespace

InverseLugre::InverseLugre(std::span<const ComponentForces> runs) {
  for (const auto& from : runs) {
    Run run;
    const auto& x = from.position_m;
    for (std::size_t i = 1; i + 2 < x.size(); ++i) {
      run.velocity.push_back((x[i + 1] - x[i]) / from.sample_s);
      run.speed.push_back(std::abs(run.velocity.back()));
      run.travel_m.push_back(std::abs(x[i + 1] - x[i]));
      run.acceleration.push_back((x[i + 2] - x[i + 1] - x[i] + x[i - 1]) / (2.0 * from.sample_s * from.sample_s));
      run.force_N.push_back(from.total_N[i]);
    }
    samples_ += run.speed.size();
    runs_.push_back(std::move(run));
  }
}

std::optional<InverseLugreFit> InverseLugre::fit(const InverseLugreStart& start) const {
  if (samples_ < 50) return std::nullopt;
  const Projected projected(runs_, samples_);
  ceres::TinySolver<Projected> solver{};
  solver.options.max_num_iterations = 30;
  solver.options.gradient_tolerance = 1e-8;
  solver.options.function_tolerance = 1e-6;
  Vector3 x{-std::log(start.bristle_length_m), std::log(std::max(start.static_over_coulomb - 1.0, 1e-3)),
            std::log(start.stribeck_m_per_s)};
  solver.Solve(projected, &x);
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(samples_));
  const Vector5 linear = projected.solve(x, residuals);
  const Shape shape(x);
  InverseLugreFit fit{linear[0],
                      linear[1],
                      linear[1] * (1.0 + shape.rise),
                      shape.stribeck_m_per_s,
                      linear[3],
                      linear[1] * shape.per_length,
                      linear[2],
                      linear[4],
                      residuals.squaredNorm(),
                      solver.summary.iterations};
  return std::isfinite(fit.cost) && fit.coulomb_N > 0.0 ? std::optional(fit) : std::nullopt;
}

double InverseLugre::cost(const InverseLugreFit& at) const {
  Bristle bristle;
  const Vector5 linear{at.mass_kg, at.coulomb_N, at.damping_Ns_per_m, at.viscous_Ns_per_m, at.offset_N};
  double sum = 0.0;
  for (const auto& run : runs_) {
    bristle.follow(run, at.stiffness_N_per_m / at.coulomb_N, at.static_N / at.coulomb_N - 1.0, at.stribeck_m_per_s);
    for (std::size_t i = 0; i < run.speed.size(); ++i) {
      const double off_N = regressors_of(run, bristle, i).dot(linear) - run.force_N[i];
      sum += off_N * off_N;
    }
  }
  return sum;
}

}  // namespace feedtwin::tools
