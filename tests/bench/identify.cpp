// Identification against general searches on the same cost and data; tests/bench/identify.py runs it beside scipy and prints
// the table.
//
//   bench_identify            times of the projected fits, of the source's genetic algorithm and of the output error, as
//   JSON bench_identify costs      a cost for each point that comes in on standard input, for searches in other languages:
//                             a line "stribeck|inverse COUNT", then COUNT lines of parameters; answers COUNT lines

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/support/testbed.h"
#include "tools/identify/axis_unknowns.h"
#include "tools/identify/identification.h"
#include "tools/identify/stages/by_genetic.h"
#include "tools/identify/stages/inverse_lugre.h"

namespace {

using namespace feedtwin;
using namespace feedtwin::tools;
using Json = nlohmann::json;

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

template <class Work>
double median_seconds(int times, const Work& work) {
  std::vector<double> all;
  for (int i = 0; i < times; ++i) all.push_back(seconds_of(work));
  std::ranges::nth_element(all, all.begin() + times / 2);
  return all[static_cast<std::size_t>(times) / 2];
}

/// The ball screw's Stribeck curve of Table 2 at 200 speeds, with 0.5 N of noise.
StribeckCurve stribeck_curve() {
  const auto& p = plant::source_axis().ball_screw;
  const StribeckFit truth{p.coulomb_N.pos, p.static_N.pos, p.stribeck_m_per_s.pos, p.viscous_Ns_per_m.pos, 0.0};
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise_N(0.0, 0.5);
  StribeckCurve curve;
  for (int i = 0; i < 200; ++i) {
    const double v = 1e-4 * std::pow(1000.0, i / 199.0);
    curve.speed_m_per_s.push_back(v);
    curve.force_N.push_back(truth.force_N(v) + noise_N(random));
    curve.weight.push_back(1.0);
  }
  return curve;
}

/// An 8 s sine that the plant itself made.
Recording eight_seconds() {
  return tests::make_recording(plant::source_axis(), {.motion = "sine",
                                                      .settings = {.amplitude_m = 0.01, .speed_m_per_s = 0.03},
                                                      .duration_s = 8.0,
                                                      .torque_noise_Nm = 5e-4,
                                                      .force_noise_N = 0.06,
                                                      .resolution = plant::one_count});
}

/// M, F_C, F_S - F_C, v_S, mu, sigma0, sigma1, offset
constexpr double inverse_low[] = {20.0, 20.0, 0.0, 1e-4, 0.0, 1e6, 0.0, -50.0};
constexpr double inverse_high[] = {200.0, 300.0, 200.0, 2e-2, 1e4, 2e8, 1e6, 50.0};

template <class Point>
double inverse_cost(const InverseLugre& model, const Point& x) {
  return model.cost({x[0], x[1], x[1] + x[2], x[3], x[4], x[5], x[6], x[7], 0.0, 0});
}

template <class Point>
double stribeck_cost(const StribeckCurve& curve, const Point& x) {
  const StribeckFit fit{x[0], x[0] + x[1], x[2], x[3], 0.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < curve.force_N.size(); ++i)
    sum += std::pow(fit.force_N(curve.speed_m_per_s[i]) - curve.force_N[i], 2);
  return sum;
}

InverseLugre inverse_model() {
  const auto recording = eight_seconds();
  return InverseLugre(std::vector{component_forces(recording, plant::source_axis().axis.lead_m)});
}

Json stribeck_figures() {
  const auto curve = stribeck_curve();
  Json out;
  out["cost"] = fit_stribeck_curve(curve)->cost;
  out["seconds"] = median_seconds(500, [&] { static_cast<void>(fit_stribeck_curve(curve)); });
  out["ga_seconds"] = seconds_of([&] { out["ga_cost"] = fit_stribeck_curve_by_genetic(curve)->cost; });
  return out;
}

Json inverse_figures() {
  const InverseLugre model = inverse_model();
  std::mt19937_64 random(2);
  const auto about = [&random](double middle, double factor) {
    return middle * std::exp(std::uniform_real_distribution<double>(-std::log(factor), std::log(factor))(random));
  };
  std::vector<double> costs, seconds;
  for (int start = 0; start < 40; ++start) {
    const InverseLugreStart from{about(2e-6, 10.0), 1.0 + about(0.2, 5.0), about(1e-3, 5.0)};
    std::optional<InverseLugreFit> fit;
    seconds.push_back(seconds_of([&] { fit = model.fit(from); }));
    costs.push_back(fit ? fit->cost : 1e300);
  }
  const double best = std::ranges::min(costs);
  std::ranges::sort(seconds);
  Json out{{"cost", best}, {"starts", costs.size()}, {"seconds", seconds[seconds.size() / 2]}};
  out["starts_at_optimum"] = std::ranges::count_if(costs, [best](double cost) { return cost < best * (1.0 + 1e-4); });
  const Eigen::VectorXd low = Eigen::Map<const Eigen::VectorXd>(inverse_low, 8),
                        high = Eigen::Map<const Eigen::VectorXd>(inverse_high, 8);
  const auto batch = [&model](const Eigen::MatrixXd& points) {
    Eigen::VectorXd all(points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) all[p] = inverse_cost(model, points.col(p));
    return all;
  };
  out["ga_seconds"] = seconds_of([&] {
    const auto found = evolve(low, high, batch);
    out["ga_cost"] = found.cost;
    out["ga_evaluations"] = found.evaluations;
  });
  return out;
}

/// All parameters of the axis on closed-loop simulation: by the command alone, and with all sensors.
Json output_error_figures() {
  Json out;
  for (const bool sensors : {false, true}) {
    Case made;
    made.axis = plant::source_axis();
    made.axis.ball_screw.coulomb_N = {63.0, 71.0};
    made.axis.ball_screw.static_N = {76.0, 88.0};
    made.axis.motor.inertia_kgm2 *= 0.95;
    made.fit.push_back(eight_seconds());
    if (!sensors) {
      for (const char* name : {"torque_sensor_Nm", "force_sensor_N", "power_W"}) made.fit[0].channels.erase(name);
    }
    std::vector<double> seconds;
    for (int i = 0; i < 5; ++i) {
      const auto found = identify_case(made, {});
      seconds.push_back(found.stage_seconds + found.seconds);
    }
    std::ranges::sort(seconds);
    out[sensors ? "seconds_all_sensors" : "seconds_command_only"] = seconds[2];
  }
  return out;
}

void answer_costs() {
  const auto curve = stribeck_curve();
  const InverseLugre model = inverse_model();
  std::string what;
  std::size_t count = 0;
  while (std::cin >> what >> count) {
    std::string answer;
    for (std::size_t i = 0; i < count; ++i) {
      double x[8] = {};
      for (int p = 0; p < (what == "stribeck" ? 4 : 8); ++p) std::cin >> x[p];
      answer += fmt::format("{:.17g}\n", what == "stribeck" ? stribeck_cost(curve, x) : inverse_cost(model, x));
    }
    std::cout << answer << std::flush;
  }
}

}  // namespace

int main(int argc, char**) {
  if (argc > 1) {
    answer_costs();
    return 0;
  }
  const Json out{{"stribeck", stribeck_figures()}, {"inverse", inverse_figures()}, {"output_error", output_error_figures()}};
  fmt::print("{}\n", out.dump(2));
}
