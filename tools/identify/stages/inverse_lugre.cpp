#include "tools/identify/stages/inverse_lugre.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "plant/lugre.h"
#include "tools/identify/lanes/dispatch.h"

namespace feedtwin::tools {
namespace {

using lanes::bristle_columns;
using lanes::motion_columns;
using Vector3 = Eigen::Vector3d;
using Vector5 = Eigen::Matrix<double, 5, 1>;

constexpr double difference_step = 1e-4;  // of the logarithms that are searched for

/// What is searched for, as logarithms: positive by construction.
lanes::FrictionShape shape_at(const Vector3& x) {
  return {std::exp(x[0]), std::exp(x[1]), std::exp(-x[2])};
}

enum Column : Eigen::Index { force = 0, rate = 4, acceleration = 8, velocity, one, measured, columns };
constexpr std::array<Eigen::Index, 5> regressors{acceleration, force, rate, velocity, one};
using Products = Eigen::Matrix<double, columns, columns>;

lanes::MotionView view_of(const InverseLugre::Run& run) {
  return {run.velocity.size(), run.sample_s, run.velocity.data(), run.acceleration.data(), run.force_N.data()};
}

/// The cost about a point, after the best five linear numbers.
struct Projection {
  Vector3 at;
  Vector5 linear;
  Eigen::Matrix4d triangle;  ///< T' T: products of the residuals' three slopes and the residuals, in this order
};

/// Residuals after the best five linear numbers, for TinySolver. It goes by products of residuals and slopes alone, and four
/// rows that have the same products stand in for all the record's.
class Projected {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = 4, NUM_PARAMETERS = 3 };

  explicit Projected(std::span<const InverseLugre::Run> runs) : runs_(runs), kernel_(lanes::best_kernel().inverse) {
    motion_.setZero();
    for (const auto& run : runs) {
      for (std::size_t i = 0; i < run.velocity.size(); ++i) {
        const Eigen::Vector4d row{run.acceleration[i], run.velocity[i], 1.0, run.force_N[i]};
        motion_ += row * row.transpose();
      }
    }
  }

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Vector3> x(parameters);
    const Projection& here = project(x);
    Eigen::Map<Eigen::Vector4d> r(residuals);
    r = here.triangle.col(3);
    if (jacobian != nullptr) Eigen::Map<Eigen::Matrix<double, 4, 3>>{jacobian} = here.triangle.leftCols<3>();
    return here.triangle.allFinite();
  }

  /// The last point's is kept: the solver asks for a point's cost first and for its slopes when it goes there.
  const Projection& project(const Vector3& x) const {
    if (last_.at == x) return last_;
    const Products products = products_at(x);
    Eigen::Matrix<double, 5, 5> normal;
    Vector5 right;
    for (Eigen::Index i = 0; i < 5; ++i) {
      for (Eigen::Index j = 0; j < 5; ++j)
        normal(i, j) = products(regressors.at(std::size_t(i)), regressors.at(std::size_t(j)));
      right[i] = products(regressors.at(std::size_t(i)), measured);
    }
    const Vector5 size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Eigen::Matrix<double, 5, 5> scaled = size.asDiagonal() * normal * size.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    const auto solver = scaled.ldlt();
    last_.at = x;
    last_.linear = size.cwiseProduct(solver.solve(size.cwiseProduct(right)));
    // columns: what the model gains by each of the three, and the residual; then what the five linear numbers take of them
    Eigen::Matrix<double, columns, 4> made = Eigen::Matrix<double, columns, 4>::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      made(force + 1 + k, k) = last_.linear[1] / difference_step;
      made(rate + 1 + k, k) = last_.linear[2] / difference_step;
    }
    for (Eigen::Index i = 0; i < 5; ++i) made(regressors.at(std::size_t(i)), 3) = last_.linear[i];
    made(measured, 3) = -1.0;
    Eigen::Matrix<double, 5, 4> on_regressors;
    for (Eigen::Index i = 0; i < 5; ++i) on_regressors.row(i) = size[i] * products.row(regressors.at(std::size_t(i))) * made;
    on_regressors.col(3).setZero();  // but for rounding
    const Eigen::Matrix4d left =
        made.transpose() * products * made - on_regressors.transpose() * solver.solve(on_regressors);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(0.5 * (left + left.transpose()));
    last_.triangle = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
    return last_;
  }

 private:
  Products products_at(const Vector3& x) const {
    std::array<lanes::FrictionShape, lanes::shapes_at_once> shapes;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      Vector3 beside = x;
      if (s > 0) beside[static_cast<Eigen::Index>(s) - 1] += difference_step;
      shapes[s] = shape_at(beside);
    }
    lanes::InverseSums sums;
    for (const auto& run : runs_) kernel_(view_of(run), shapes.data(), sums);
    Products products;
    for (std::size_t i = 0; i < bristle_columns; ++i) {
      for (std::size_t j = 0; j < bristle_columns + motion_columns; ++j) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        products(row, column) = products(column, row) = sums.products[i][j];
      }
    }
    products.bottomRightCorner<motion_columns, motion_columns>() = motion_;
    return products;
  }

  std::span<const InverseLugre::Run> runs_;
  lanes::InverseKernel kernel_;
  Eigen::Matrix4d motion_;
  mutable Projection last_{Vector3::Constant(std::nan("")), {}, {}};
};

}  // namespace

InverseLugre::InverseLugre(std::span<const ComponentForces> runs) {
  for (const auto& from : runs) {
    Run run;
    run.sample_s = from.sample_s;
    const auto& x = from.position_m;
    for (std::size_t i = 1; i + 2 < x.size(); ++i) {
      run.velocity.push_back((x[i + 1] - x[i]) / from.sample_s);
      run.acceleration.push_back((x[i + 2] - x[i + 1] - x[i] + x[i - 1]) / (2.0 * from.sample_s * from.sample_s));
      run.force_N.push_back(from.total_N[i]);
    }
    samples_ += run.velocity.size();
    runs_.push_back(std::move(run));
  }
}

std::optional<InverseLugreFit> InverseLugre::fit(const InverseLugreStart& start) const {
  if (samples_ < 50) return std::nullopt;
  const Projected projected(runs_);
  ceres::TinySolver<Projected> solver{};
  solver.options.max_num_iterations = 40;
  solver.options.gradient_tolerance = 1e-8;
  solver.options.initial_trust_region_radius = 100.0;
  Vector3 x{-std::log(start.bristle_length_m), std::log(std::max(start.static_over_coulomb - 1.0, 1e-3)),
            std::log(start.stribeck_m_per_s)};
  // the solver's tolerance is absolute
  solver.options.function_tolerance = 3e-7 * projected.project(x).triangle.col(3).squaredNorm();
  solver.Solve(projected, &x);
  const Vector5 linear = projected.project(x).linear;
  const auto shape = shape_at(x);
  InverseLugreFit fit{linear[0],
                      linear[1],
                      linear[1] * (1.0 + shape.rise),
                      1.0 / shape.inverse_stribeck_s_per_m,
                      linear[3],
                      linear[1] * shape.per_length_per_m,
                      linear[2],
                      linear[4],
                      0.0,
                      solver.summary.iterations};
  fit.cost = cost(fit);
  return std::isfinite(fit.cost) && fit.coulomb_N > 0.0 ? std::optional(fit) : std::nullopt;
}

double InverseLugre::cost(const InverseLugreFit& at) const {
  const plant::LugreBristle<double> bristle{at.stiffness_N_per_m, 1.0 / at.stiffness_N_per_m, at.damping_Ns_per_m};
  const plant::LugreSide<double> side{at.coulomb_N, at.static_N - at.coulomb_N, 1.0 / at.stribeck_m_per_s,
                                      at.viscous_Ns_per_m};
  double sum = 0.0;
  for (const auto& run : runs_) {
    double z_m = 0.0;
    for (std::size_t i = 0; i < run.velocity.size(); ++i) {
      const double v = run.velocity[i], sign = v < 0.0 ? -1.0 : 1.0;
      const auto step = plant::lugre_step<double>(bristle, side, sign, sign * v, z_m, run.sample_s, 1.0 / run.sample_s);
      z_m = step.bristle_m;
      const double off_N = at.mass_kg * run.acceleration[i] + step.force_N + at.offset_N - run.force_N[i];
      sum += off_N * off_N;
    }
  }
  return sum;
}

}  // namespace feedtwin::tools
