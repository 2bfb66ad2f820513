#include "tools/diagnose/fast_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "tools/diagnose/inverse_model.h"
#include "tools/diagnose/lines.h"
#include "tools/diagnose/mended_case.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr double one_frequency_Hz = 0.3;  // of the same line in two runs of some seconds
// Just above the highest the usual rows show it as well; mains hum at 100 Hz in every run would bring the rows closer.
constexpr double clearly_above = 1.03;

/// The line that all runs have in the guide's equation above a frequency, of rows a sample apart.
std::optional<double> line_of_all_runs(const InverseModel& model, double above_Hz) {
  const Vector residual = model.residual(model.nominal(), {});
  std::vector<double> lines_Hz;
  for (const auto& s : model.segments()) {
    if (!model.equations()[s.equation].guide) continue;
    const auto line_Hz = strongest_line_Hz(model, residual, s, above_Hz);
    if (!line_Hz) return {};
    lines_Hz.push_back(*line_Hz);
  }
  if (lines_Hz.empty()) return {};
  const auto [least, most] = std::ranges::minmax(lines_Hz);
  return most - least < one_frequency_Hz ? std::optional(most) : std::nullopt;
}

}  // namespace

TrackSettings track_settings(const Case& data, const std::function<void(std::string_view)>& progress) {
  TrackSettings settings{.jump_shares = shown_jump_shares(data, progress), .samples_a_row = 1};
  const InverseModel every_sample(make_tracks(data.fit, data.axis, settings), data.axis);
  const double sample_s = every_sample.tracks().front().sample_s;
  settings.samples_a_row = usual_samples_a_row;
  const auto line_Hz = line_of_all_runs(every_sample, clearly_above * highest_line_Hz(usual_samples_a_row, sample_s));
  if (!line_Hz || *line_Hz > highest_line_Hz(1, sample_s)) return settings;
  while (settings.samples_a_row > 1 && highest_line_Hz(settings.samples_a_row, sample_s) < *line_Hz)
    settings.samples_a_row /= 2;
  progress(fmt::format("all runs have a line at {:.1f} Hz: rows are {} ms apart", *line_Hz,
                       1e3 * sample_s * static_cast<double>(settings.samples_a_row)));
  return settings;
}

}  // namespace feedtwin::tools::diagnosis
