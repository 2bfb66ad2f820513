#include "tools/identify/stages/stage_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "plant/parameter_table.h"
#include "plant/steady_friction.h"

namespace feedtwin::tools {
namespace {

double electrical_loss_W(const plant::MotorParameters& motor, double v) {
  const bool positive = v > 0.0;
  const auto& linear = motor.electrical_linear_Ws_per_m;
  const auto& quadratic = motor.electrical_quadratic_Ws2_per_m2;
  return motor.electrical_idle_W + (positive ? linear.pos : linear.neg) * std::abs(v) +
         (positive ? quadratic.pos : quadratic.neg) * v * v;
}

Figure loss_figure(const ElectricalLossFit& fit, const plant::AxisParameters& axis) {
  FigureSeries curve{"identified, Eq. 7", {}, {}};
  const auto [low, high] = std::ranges::minmax(fit.velocity_m_per_s);
  for (int i = 0; i <= 200; ++i) {
    curve.x.push_back(low + (high - low) * i / 200.0);
    curve.y.push_back(electrical_loss_W(axis.motor, curve.x.back()));
  }
  return {"Electrical loss of the motor over speed",
          {"velocity", "m/s"},
          {"loss", "W"},
          {{"meter's windows, Eq. 11", fit.velocity_m_per_s, fit.measured_W, true}, curve}};
}

Figure stribeck_figure(const ContactStages& stages, const plant::LugreParameters& friction) {
  Figure figure{"Stribeck curve: " + stages.component, {"velocity", "m/s"}, {"friction", "N"}, {}};
  for (const bool positive : {true, false}) {
    const auto& curve = positive ? stages.curve_pos : stages.curve_neg;
    const double sign = positive ? 1.0 : -1.0;
    FigureSeries points{positive ? "measured, positive" : "measured, negative", {}, {}, true};
    FigureSeries line{positive ? "identified, positive" : "identified, negative", {}, {}};
    for (std::size_t i = 0; i < curve.force_N.size(); ++i) {
      points.x.push_back(sign * curve.speed_m_per_s[i]);
      points.y.push_back(sign * curve.force_N[i]);
      line.x.push_back(points.x.back());
      line.y.push_back(plant::steady_force_N(friction, points.x.back()));
    }
    figure.series.push_back(std::move(points));
    figure.series.push_back(std::move(line));
  }
  return figure;
}

/// The run that stays nearest to pre-sliding: its loop is drawn.
const Recording* smallest_travel(std::span<const Recording> recordings) {
  const auto travel = [](const Recording& r) {
    const auto [low, high] = std::ranges::minmax(r.at(channel::position_m));
    return high - low;
  };
  return recordings.empty() ? nullptr : &*std::ranges::min_element(recordings, {}, travel);
}

Figure hysteresis_figure(const std::string& component, const Recording& recording, const plant::AxisParameters& axis) {
  const bool screw = component == "ball_screw";
  const auto forces = component_forces(recording, axis.axis.lead_m);
  const double k = 2.0 * std::numbers::pi / axis.axis.lead_m;
  const double mass_kg = screw ? axis.ball_screw_inertia_kgm2 * k * k : axis.guide_mass_kg;
  const auto& friction = screw ? axis.ball_screw : axis.guide;
  const auto model = HysteresisCost::model_N(forces, mass_kg, friction);
  const auto& measured = screw ? forces.screw_N : forces.guide_N;
  FigureSeries points{"measured", {}, {}, true}, line{"identified", {}, {}};
  // the last second at most: some loops, not all of them one upon the other
  const auto rows = std::min(measured.size() - 2, static_cast<std::size_t>(1.0 / recording.sample_s));
  for (std::size_t i = measured.size() - 2 - rows; i + 2 < measured.size(); ++i) {
    const double inertial_N = mass_kg * forces.acceleration_m_per_s2[i];
    points.x.push_back(1e6 * (forces.position_m[i] - forces.position_m.front()));
    points.y.push_back(measured[i] - inertial_N);
    line.x.push_back(points.x.back());
    line.y.push_back(model[i] - inertial_N);
  }
  return {"Hysteresis: " + component + ", " + std::filesystem::path(recording.file).filename().string(),
          {"travel", "um"},
          {"friction", "N"},
          {points, line}};
}

}  // namespace

nlohmann::json to_json(const StagedFit& fit) {
  nlohmann::json out{{"parameters", nlohmann::json::object()}, {"notes", fit.notes}};
  plant::AxisParameters axis = fit.axis;
  for (const auto& key : fit.keys) out["parameters"][key] = plant::find_parameter(key)->in(axis);
  if (fit.electrical) out["electrical_rms_W"] = fit.electrical->rms_W;
  for (const auto& contact : fit.contacts) {
    if (contact.presliding) out["hysteresis_rms_N"][contact.component] = contact.presliding->rms_N;
  }
  return out;
}

std::vector<Figure> figures_of(const StagedFit& fit, std::span<const Recording> recordings,
                               const plant::AxisParameters& axis) {
  std::vector<Figure> figures;
  if (fit.electrical && !fit.electrical->velocity_m_per_s.empty()) figures.push_back(loss_figure(*fit.electrical, axis));
  const Recording* loops = smallest_travel(recordings);
  for (const auto& contact : fit.contacts) {
    const auto& friction = contact.component == "ball_screw" ? axis.ball_screw : axis.guide;
    figures.push_back(stribeck_figure(contact, friction));
    const bool sensed =
        loops->has(channel::force_sensor_N) && (contact.component == "guide" || loops->has(channel::torque_sensor_Nm));
    if (sensed) figures.push_back(hysteresis_figure(contact.component, *loops, axis));
  }
  return figures;
}

}  // namespace feedtwin::tools
