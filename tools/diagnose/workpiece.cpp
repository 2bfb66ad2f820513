#include "tools/diagnose/workpiece.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t places = 150;

/// Of one equation of one run: what the rows hold of a line up to each place along the travel.
struct UpTo {
  std::vector<std::complex<double>> sum = std::vector<std::complex<double>>(places + 1);
  std::vector<double> rows = std::vector<double>(places + 1);

  /// Power of the line between two places.
  [[nodiscard]] double power(std::size_t from, std::size_t to) const {
    const double n = rows[to] - rows[from];
    return n > 0.0 ? std::norm(sum[to] - sum[from]) / n : 0.0;
  }
};

double position_m(const Travel& travel, std::size_t place) {
  return travel.low_m + travel.length_m() * static_cast<double>(place) / static_cast<double>(places);
}

std::size_t place_at(const Travel& travel, double position_m) {
  const double share = (position_m - travel.low_m) / (travel.length_m() + 1e-12);
  return std::min(places - 1, static_cast<std::size_t>(share * static_cast<double>(places)));
}

/// Means over a tenth of a second: friction of another size is no line, but turned with the motion it stands above any.
Vector slow_part(const Vector& rows) {
  constexpr Index about_rows = 12;
  Vector slow(rows.size());
  double sum = 0.0;
  Index from = 0, to = 0;  // of the window, its end excluded
  for (Index k = 0; k < rows.size(); ++k) {
    for (; to < std::min(rows.size(), k + about_rows + 1); ++to) sum += rows[to];
    for (; from < k - about_rows; ++from) sum -= rows[from];
    slow[k] = sum / static_cast<double>(to - from);
  }
  return slow;
}

UpTo up_to_places(const InverseModel& model, const Segment& s, const Vector& rows, double frequency_Hz, const Travel& travel,
                  double only_direction) {
  const Track& track = model.tracks()[s.run];
  const double per_row = 2.0 * std::numbers::pi * frequency_Hz * track.row_s();
  UpTo up;
  for (Index k = 0; k < s.size; ++k) {
    if (only_direction * track.centred_m_per_s[model.sample_of(s, k)] < 0.0) continue;
    const std::size_t place = place_at(travel, track.table_position_m[model.sample_of(s, k)]) + 1;
    up.sum[place] += rows[s.start + k] * std::polar(1.0, per_row * static_cast<double>(k));
    up.rows[place] += 1.0;
  }
  for (std::size_t i = 1; i <= places; ++i) up.sum[i] += up.sum[i - 1], up.rows[i] += up.rows[i - 1];
  return up;
}

}  // namespace

Vector turned(const InverseModel& model, const Vector& rows) {
  Vector out = rows;
  for (const auto& s : model.segments()) {
    for (Index k = 0; k < s.size; ++k)
      if (model.tracks()[s.run].centred_m_per_s[model.sample_of(s, k)] < 0.0) out[s.start + k] = -out[s.start + k];
    out.segment(s.start, s.size) -= slow_part(out.segment(s.start, s.size));
    for (Index k = 0; k < s.size; ++k)
      if (!model.settled(s.start + k)) out[s.start + k] = 0.0;  // friction holds the table, or turns over
  }
  return out;
}

std::optional<Workpiece> place_of_line(const InverseModel& model, const Vector& rows, double frequency_Hz) {
  // what the best of ten thousand pairs of places gains by chance, and what a model's mistakes about reversals bring
  constexpr double by_chance = 10.0, times_as_much = 1.1;
  constexpr std::size_t least_places = places / 8, most_places = 17 * places / 20;
  const Travel travel = travel_of(model.tracks(), &Track::table_position_m);
  std::optional<Workpiece> best;
  double most = 0.0;
  for (const double only_direction : {0.0, 1.0, -1.0}) {
    std::vector<UpTo> all;
    for (const auto& s : model.segments())
      if (model.equations()[s.equation].guide && s.size > 0)
        all.push_back(up_to_places(model, s, rows, frequency_Hz, travel, only_direction));
    const auto power = [&](std::size_t from, std::size_t to) {
      double sum = 0.0;
      for (const auto& up : all) sum += up.power(from, to);
      return sum;
    };
    most = std::max(most, times_as_much * power(0, places) + by_chance);
    for (std::size_t from = 0; from + least_places <= places; ++from)
      for (std::size_t to = from + least_places; to <= std::min(places, from + most_places); ++to)
        if (const double now = power(from, to); now > most)
          most = now, best = {position_m(travel, from), position_m(travel, to), only_direction};
  }
  return best;
}

}  // namespace feedtwin::tools::diagnosis
