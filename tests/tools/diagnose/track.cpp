// The recorded motion as friction is followed along it: without what the encoder's grid makes of an axis at rest.

#include "tools/diagnose/track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plant/parameter_table.h"

namespace feedtwin {
namespace {

using namespace tools::diagnosis;

constexpr double count_m = 0.005 / 65536;

tools::Recording of_positions(const std::vector<double>& position_m) {
  tools::Recording recording;
  recording.file = "made.csv";
  recording.sample_s = 1e-3;
  recording.channels[std::string(tools::channel::position_m)] = position_m;
  recording.channels[std::string(tools::channel::torque_cmd_Nm)] = std::vector<double>(position_m.size(), 0.0);
  return recording;
}

double on_grid(double x_m) {
  return std::round(x_m / count_m) * count_m;
}

double travelled_m(const Vector& path_m_per_s) {
  return path_m_per_s.cwiseAbs().sum() * 1e-3 / path_substeps;
}

// Whatever the place between two counts and however often one of them is off.
TEST(Track, AnAxisAtRestDoesNotMove) {
  std::mt19937 random(1);  // NOLINT(bugprone-random-generator-seed): the same flicker each time
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  std::normal_distribution<double> noise(0.0, 0.15);
  for (int draw = 0; draw < 20; ++draw) {
    const double place_counts = 100.0 + anywhere(random);
    std::vector<double> x;
    for (int i = 0; i < 3000; ++i) x.push_back(on_grid((place_counts + noise(random)) * count_m));
    const Track track = make_track(of_positions(x), plant::source_axis());
    EXPECT_LT(travelled_m(track.path_m_per_s.segment(400, 10000)), 3.0 * count_m) << place_counts;
    EXPECT_LT(track.steady_m_per_s.segment(100, 2500).cwiseAbs().sum() * 1e-3, 3.0 * count_m) << place_counts;
  }
}

// Slow or fast, a turn keeps its depth to a count: pre-sliding is a micrometre.
TEST(Track, AnAxisThatTurnsKeepsItsPath) {
  for (const double amplitude_m : {1e-6, 1e-5, 1e-3})
    for (const double frequency_Hz : {0.5, 2.0, 8.0}) {
      std::vector<double> x;
      for (int i = 0; i < 3000; ++i) x.push_back(on_grid(amplitude_m * std::sin(2.0 * M_PI * frequency_Hz * i * 1e-3)));
      const Track track = make_track(of_positions(x), plant::source_axis());
      double at_m = track.position_m[0], farthest_m = 0.0;
      for (Index k = 0; k + 1 < track.size; ++k) {
        farthest_m = std::max(farthest_m, std::abs(at_m - track.position_m[k]));
        at_m += track.path_m_per_s.segment(k * path_substeps, path_substeps).sum() * 1e-3 / path_substeps;
      }
      EXPECT_LT(farthest_m, 1.7 * count_m) << amplitude_m << " m at " << frequency_Hz << " Hz";
    }
}

}  // namespace
}  // namespace feedtwin
