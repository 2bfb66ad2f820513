#pragma once
// The bristle of a friction shape, and its slopes, over a block of ticks.
//
// With zeta = z / length, the deflection in units of F_C, the plant's step (plant/lugre.h) is affine in what the tick begins
// with,
//
//   zeta' = E zeta + s g (1 - E),   f = phi zeta + s g (1 - phi),   g = 1 + rise e^(-w / v_S),   y = w h / (g length)
//
// with numbers that only the tick's velocity s w decides: they are worked out for many ticks at once. So are its slopes by
// ln(1 / length), rise and ln v_S, which y' = y, g' = e^(-w / v_S) and g' = rise e^(-w / v_S) w / v_S begin,
//
//   d zeta' = E d zeta + (y' dE/dy) (zeta - s g) + g' s (1 - E),   df likewise with phi,   y' = -y g' / g where g has a
//   slope
//
// and what is left to do tick after tick are sums of the form x' = E x + q. Through one stream's ticks that is again
// x_end = P x_begin + Q, so that all streams of a block go side by side from zero, and only their ends one after the other.

#include "plant/lugre.h"
#include "tools/identify/lanes/block_columns.h"
#include "tools/identify/lanes/inverse_kernel.h"

namespace feedtwin::tools::lanes {

template <class Real>
class BristleBlock {
 public:
  static constexpr std::size_t width = sizeof(Real) / sizeof(double);
  static_assert(streams % width == 0);

  /// The bristle starts unloaded.
  BristleBlock(const FrictionShape& shape, double tick_s) noexcept : shape_(shape), tick_s_(tick_s) {}

  /// The next block_ticks ticks, streamed. @param columns bristle_columns of them
  void follow(const double* velocity_m_per_s, double (*columns)[block_ticks]) noexcept {
    for (std::size_t first = 0; first < streams; first += width) relax(velocity_m_per_s, first);
    join<1>(&end_sum_, &begin_);
    for (std::size_t first = 0; first < streams; first += width) deflect(columns, first);
    join<shape_slopes>(end_slope_sums_, begin_slopes_);
    for (std::size_t first = 0; first < streams; first += width) slope(columns, first);
  }

 private:
  using Block = double[block_ticks];
  using Ends = double[streams + 1];  // each stream's begin, and the block's end

  /// What only the velocity decides; products of E and sums of zeta from nothing up to every tick.
  void relax(const double* velocity_m_per_s, std::size_t first) noexcept {
    const double per_length = shape_.per_length_per_m, length_m = 1.0 / per_length;
    // without damping and viscous friction: their forces are linear and come from the rate and the velocity
    const plant::LugreBristle<Real> bristle{Real{} + per_length, Real{} + length_m, Real{}};
    const plant::LugreSide<Real> side{Real{} + 1.0, Real{} + shape_.rise, Real{} + shape_.inverse_stribeck_s_per_m, Real{}};
    Real product = Real{} + 1.0, sum{};
    for (std::size_t at = first; at < block_ticks; at += streams) {
      const Real v = load_ticks<Real>(velocity_m_per_s + at);
      const Real sign = v < 0.0 ? Real{} - 1.0 : Real{} + 1.0;
      const Real speed = sign * v;
      const auto step_from = [&](double z_m) {
        return plant::lugre_step<Real>(bristle, side, sign, speed, Real{} + z_m, Real{} + tick_s_, Real{} + 1.0 / tick_s_);
      };
      const auto unloaded = step_from(0.0), loaded = step_from(length_m);
      const Real keep = (loaded.bristle_m - unloaded.bristle_m) * per_length, gain = unloaded.bristle_m * per_length;
      store_ticks<Real>(product_ + at, product);
      store_ticks<Real>(sum_ + at, sum);
      product *= keep;
      sum = keep * sum + gain;
      const Real g = plant::stribeck_force_N<Real>(side, speed), per_g = 1.0 / g;
      const Real y = (per_length * tick_s_) * speed * per_g;
      const Real quotient = 1.0 + y * (0.5 + (1.0 / 6.0) * y);  // phi / E
      const Real falls = -y * keep * keep * (1.0 + y * (1.0 + 0.5 * y));
      store_ticks<Real>(keep_ + at, keep);
      store_ticks<Real>(gain_ + at, gain);
      store_ticks<Real>(mean_ + at, loaded.force_N - unloaded.force_N);
      store_ticks<Real>(rest_ + at, unloaded.force_N);
      store_ticks<Real>(falls_ + at, falls);
      store_ticks<Real>(mean_falls_ + at, falls * quotient + keep * y * (0.5 + (1.0 / 3.0) * y));
      store_ticks<Real>(steady_ + at, sign * g);
      const Real speeds = speed * shape_.inverse_stribeck_s_per_m;
      store_ticks<Real>(share_ + at, plant::exp_of_minus<Real>(speeds) * per_g);
      store_ticks<Real>(speeds_ + at, shape_.rise * speeds);
    }
    store_ticks<Real>(end_product_ + first, product);
    store_ticks<Real>(end_sum_ + first, sum);
  }

  /// Force and rate; sums of the slopes of zeta from nothing up to every tick.
  void deflect(double (*columns)[block_ticks], std::size_t first) noexcept {
    const double per_h_per_length = 1.0 / (tick_s_ * shape_.per_length_per_m);
    const Real begin = load_ticks<Real>(begin_ + first);
    Real sums[shape_slopes] = {};
    for (std::size_t at = first; at < block_ticks; at += streams) {
      const Real zeta = load_ticks<Real>(product_ + at) * begin + load_ticks<Real>(sum_ + at);
      const Real keep = load_ticks<Real>(keep_ + at), gain = load_ticks<Real>(gain_ + at);
      const Real rest = load_ticks<Real>(rest_ + at), off = zeta - load_ticks<Real>(steady_ + at);
      const Real share = load_ticks<Real>(share_ + at), speeds = load_ticks<Real>(speeds_ + at);
      store_ticks<Real>(columns[0] + at, load_ticks<Real>(mean_ + at) * zeta + rest);
      store_ticks<Real>(columns[1 + shape_slopes] + at, (keep * zeta + gain - zeta) * per_h_per_length);
      const Real force_by_length = load_ticks<Real>(mean_falls_ + at) * off,
                 force_by_rise = share * (rest - force_by_length);
      const Real by_length = load_ticks<Real>(falls_ + at) * off, by_rise = share * (gain - by_length);
      const Real force_by[shape_slopes] = {force_by_length, force_by_rise, speeds * force_by_rise};
      const Real by[shape_slopes] = {by_length, by_rise, speeds * by_rise};
      for (std::size_t k = 0; k < shape_slopes; ++k) {
        store_ticks<Real>(columns[1 + k] + at, force_by[k]);
        store_ticks<Real>(slope_sums_[k] + at, sums[k]);
        sums[k] = keep * sums[k] + by[k];
      }
    }
    for (std::size_t k = 0; k < shape_slopes; ++k) store_ticks<Real>(end_slope_sums_[k] + first, sums[k]);
  }

  /// Slopes of force and rate.
  void slope(double (*columns)[block_ticks], std::size_t first) noexcept {
    const double per_h_per_length = 1.0 / (tick_s_ * shape_.per_length_per_m);
    Real begin[shape_slopes];
    for (std::size_t k = 0; k < shape_slopes; ++k) begin[k] = load_ticks<Real>(begin_slopes_[k] + first);
    for (std::size_t k = 0; k < shape_slopes; ++k) {
      Real here = begin[k];
      for (std::size_t at = first; at < block_ticks; at += streams) {
        const std::size_t next = at + streams;
        const Real there =
            next < block_ticks
                ? load_ticks<Real>(product_ + next) * begin[k] + load_ticks<Real>(slope_sums_[k] + next)
                : load_ticks<Real>(end_product_ + first) * begin[k] + load_ticks<Real>(end_slope_sums_[k] + first);
        const Real force = load_ticks<Real>(columns[1 + k] + at) + load_ticks<Real>(mean_ + at) * here;
        Real rate = (there - here) * per_h_per_length;
        if (k == 0) rate -= load_ticks<Real>(columns[1 + shape_slopes] + at);
        store_ticks<Real>(columns[1 + k] + at, force);
        store_ticks<Real>(columns[2 + shape_slopes + k] + at, rate);
        here = there;
      }
    }
  }

  /// Streams one after the other: where each begins.
  template <std::size_t chains>
  void join(const Ends* sums, Ends* begins) const noexcept {
    for (std::size_t k = 0; k < chains; ++k) begins[k][0] = begins[k][streams];
    for (std::size_t s = 0; s < streams; ++s)
      for (std::size_t k = 0; k < chains; ++k) begins[k][s + 1] = end_product_[s] * begins[k][s] + sums[k][s];
  }

  FrictionShape shape_;
  double tick_s_;
  alignas(64) Block keep_, gain_, mean_, rest_, falls_, mean_falls_, steady_, share_, speeds_;
  alignas(64) Block product_, sum_, slope_sums_[shape_slopes];  // up to where each tick begins
  Ends end_product_, end_sum_, end_slope_sums_[shape_slopes];
  Ends begin_ = {}, begin_slopes_[shape_slopes] = {};
};

}  // namespace feedtwin::tools::lanes
