#include "plant/machine/milling_force.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace feedtwin::plant {
namespace {

constexpr double pi = std::numbers::pi;

/// Height of a disc in which the helix lags little enough to be taken as straight.
constexpr double disc_lag_rad = 0.05;

double into_turn(double angle_rad) noexcept {
  return angle_rad - 2.0 * pi * std::floor(angle_rad / (2.0 * pi));
}

}  // namespace

MillingForce::MillingForce(const ToolParameters& tool, const CuttingCoefficients& coefficients)
    : tool_(tool), k_(coefficients) {
  if (tool.teeth < 1 || tool.teeth > most_teeth) throw std::invalid_argument("a cutter has 1 to 16 teeth");
  const auto radius = [&](int tooth) {
    return tool.runout_m * std::cos(tool.runout_angle_rad + 2.0 * pi * tooth / tool.teeth);
  };
  for (int j = 0; j < tool.teeth; ++j) {
    stand_out_m_[static_cast<std::size_t>(j)] = radius(j) - radius(j + tool.teeth - 1);
  }
}

// With h = A sin + B cos + d over [a, b]:  int h sin = A SS + B SC + d S, int h cos = A SC + B CC + d C, int h = A S + B C +
// d W.
void MillingForce::add_piece(double from_rad, double to_rad, double ahead_m, double left_m, double stand_out_m, double dz_m,
                             Sums& sums) const noexcept {
  const double sa = std::sin(from_rad), ca = std::cos(from_rad), sb = std::sin(to_rad), cb = std::cos(to_rad);
  const double W = to_rad - from_rad;
  const double S = ca - cb, C = sb - sa;
  const double half_sines = 0.5 * (sb * cb - sa * ca);
  const double SS = 0.5 * W - half_sines, CC = 0.5 * W + half_sines, SC = 0.5 * (sb * sb - sa * sa);
  const double h_sin = ahead_m * SS + left_m * SC + stand_out_m * S;
  const double h_cos = ahead_m * SC + left_m * CC + stand_out_m * C;
  const double h = ahead_m * S + left_m * C + stand_out_m * W;
  const double Ft_sin = k_.Ktc_N_per_m2 * h_sin + k_.Kte_N_per_m * S, Ft_cos = k_.Ktc_N_per_m2 * h_cos + k_.Kte_N_per_m * C;
  const double Fr_sin = k_.Krc_N_per_m2 * h_sin + k_.Kre_N_per_m * S, Fr_cos = k_.Krc_N_per_m2 * h_cos + k_.Kre_N_per_m * C;
  sums.along_N += dz_m * (-Ft_cos - Fr_sin);
  sums.left_N += dz_m * (Ft_sin - Fr_cos);
  sums.axial_N += dz_m * (k_.Kac_N_per_m2 * h + k_.Kae_N_per_m * W);
  sums.tangential_N += dz_m * (k_.Ktc_N_per_m2 * h + k_.Kte_N_per_m * W);
}

/// One tooth from phi over a turn (< 2 pi per call), clipped to the immersion and to h > 0.
void MillingForce::add_tooth(double phi_rad, double turn_rad, const Immersion& immersion, double ahead_m, double left_m,
                             double stand_out_m, double dz_m, Sums& sums) const noexcept {
  const double amplitude = std::hypot(ahead_m, left_m);
  double from = immersion.entry_rad, to = immersion.exit_rad;
  if (stand_out_m < amplitude) {
    // h > 0 within acos(-d / amplitude) of its crest at atan2(ahead, left)
    if (stand_out_m <= -amplitude) return;
    const double crest = std::atan2(ahead_m, left_m), half = std::acos(-stand_out_m / amplitude);
    from = std::max(from, crest - half);
    to = std::min(to, crest + half);
  }
  for (const double shift : {0.0, 2.0 * pi}) {  // the tooth may come round once
    const double a = std::max(from, phi_rad - shift), b = std::min(to, phi_rad + turn_rad - shift);
    if (b > a) add_piece(a, b, ahead_m, left_m, stand_out_m, dz_m, sums);
  }
}

MillingLoad MillingForce::over(double angle_rad, double turn_rad, double dx_m, double dy_m,
                               const Engagement& engagement) const noexcept FEEDTWIN_REALTIME {
  MillingLoad load;
  const double turned = std::min(std::abs(turn_rad), 2.0 * pi);
  if (!engagement.cutting() || turned == 0.0) return load;
  // counterclockwise rotation is clockwise seen in a mirror: left and right change places
  const double mirror = turn_rad < 0.0 ? -1.0 : 1.0;
  const double c = std::cos(engagement.heading_rad), s = std::sin(engagement.heading_rad);
  const double ahead_m = c * dx_m + s * dy_m;
  const double left_m = mirror * (c * dy_m - s * dx_m);
  const double pitch = 2.0 * pi / tool_.teeth;
  const double lag_per_m = 2.0 * std::tan(tool_.helix_rad) / tool_.diameter_m;

  Sums sums;
  for (int i = 0; i < engagement.count; ++i) {
    Immersion immersion = engagement.immersions[static_cast<std::size_t>(i)];
    if (mirror < 0.0) {
      immersion.entry_rad = pi - engagement.immersions[static_cast<std::size_t>(i)].exit_rad;
      immersion.exit_rad = pi - engagement.immersions[static_cast<std::size_t>(i)].entry_rad;
    }
    const int discs = std::clamp(static_cast<int>(std::ceil(lag_per_m * immersion.depth_m / disc_lag_rad)), 1, most_discs);
    const double dz_m = immersion.depth_m / discs;
    for (int disc = 0; disc < discs; ++disc) {
      const double lag = lag_per_m * (disc + 0.5) * dz_m;
      for (int j = 0; j < tool_.teeth; ++j) {
        const double phi = into_turn(mirror * angle_rad + j * pitch + 0.5 * pi + mirror * engagement.heading_rad - lag);
        add_tooth(phi, turned, immersion, ahead_m, left_m, stand_out_m_[static_cast<std::size_t>(j)], dz_m, sums);
      }
    }
    load.removal_rate_m3_per_s +=
        immersion.depth_m * ahead_m * (std::cos(immersion.entry_rad) - std::cos(immersion.exit_rad));
  }
  const double along = sums.along_N / turned, left = mirror * sums.left_N / turned;
  load.force_x_N = c * along - s * left;
  load.force_y_N = s * along + c * left;
  load.force_z_N = sums.axial_N / turned;
  load.torque_Nm = 0.5 * tool_.diameter_m * sums.tangential_N / turned;
  load.removal_rate_m3_per_s *= 0.5 * tool_.diameter_m;  // per tooth period; the caller divides by its length
  return load;
}

}  // namespace feedtwin::plant
