#include "tools/machine/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace feedtwin::tools {
namespace {

constexpr double width = 760, height = 260, left = 70, right = 20, top = 30, bottom = 45;
constexpr std::array colours{"#1f5fa8", "#c0392b", "#2e8b57", "#8e5ea2", "#d4820f", "#555555"};

struct Range {
  double low = 0.0, high = 1.0;
  [[nodiscard]] double of(double value) const { return (value - low) / (high - low); }
};

Range range_of(const Plot& plot, std::vector<double> PlotLine::* values) {
  Range range{1e300, -1e300};
  for (const auto& line : plot.lines) {
    for (const double v : line.*values) {
      if (!std::isfinite(v)) continue;
      range.low = std::min(range.low, v);
      range.high = std::max(range.high, v);
    }
  }
  if (range.low > range.high) return {};
  const double margin = std::max(0.04 * (range.high - range.low), 1e-12 + 1e-3 * std::abs(range.high));
  return {range.low - margin, range.high + margin};
}

/// A round step that gives about five marks.
double mark_step(const Range& range) {
  const double raw = (range.high - range.low) / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= raw) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return safe;
}

std::string svg(const Plot& plot) {
  const Range xs = range_of(plot, &PlotLine::x), ys = range_of(plot, &PlotLine::y);
  const auto px = [&](double x) { return left + (width - left - right) * xs.of(x); };
  const auto py = [&](double y) { return height - bottom - (height - top - bottom) * ys.of(y); };
  std::string out =
      fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\"><text x=\"{}\" y=\"18\" class=\"title\">{}</text>\n", width,
                  height, left, escaped(plot.title));
  auto to = std::back_inserter(out);
  const double dx = mark_step(xs), dy = mark_step(ys);
  for (double x = std::ceil(xs.low / dx) * dx; x <= xs.high; x += dx) {
    fmt::format_to(
        to, "<path d=\"M{0:.1f} {1}V{2}\" class=\"grid\"/><text x=\"{0:.1f}\" y=\"{3}\" class=\"mark\">{4:.6g}</text>\n",
        px(x), top, height - bottom, height - bottom + 15, std::abs(x) < 1e-9 * dx ? 0.0 : x);
  }
  for (double y = std::ceil(ys.low / dy) * dy; y <= ys.high; y += dy) {
    fmt::format_to(
        to, "<path d=\"M{1} {0:.1f}H{2}\" class=\"grid\"/><text x=\"{3}\" y=\"{4:.1f}\" class=\"mark end\">{5:.6g}</text>\n",
        py(y), left, width - right, left - 6, py(y) + 4, std::abs(y) < 1e-9 * dy ? 0.0 : y);
  }
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    const auto& line = plot.lines[i];
    const char* colour = colours[i % colours.size()];
    if (line.points) {
      for (std::size_t k = 0; k < line.x.size(); ++k) {
        fmt::format_to(to, "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>", px(line.x[k]), py(line.y[k]),
                       colour);
      }
    } else {
      fmt::format_to(to, "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\" points=\"", colour);
      for (std::size_t k = 0; k < line.x.size(); ++k) fmt::format_to(to, "{:.1f},{:.1f} ", px(line.x[k]), py(line.y[k]));
      out += "\"/>\n";
    }
    fmt::format_to(to, "<text x=\"{}\" y=\"{}\" class=\"name\" fill=\"{}\">{}</text>\n", width - right - 4,
                   top + 14 * (static_cast<double>(i) + 1), colour, escaped(line.name));
  }
  fmt::format_to(to, "<text x=\"{}\" y=\"{}\" class=\"mark\">{}</text>", 0.5 * (left + width - right), height - 8,
                 escaped(plot.x_label));
  fmt::format_to(to, "<text transform=\"translate(14 {}) rotate(-90)\" class=\"mark\">{}</text></svg>\n",
                 0.5 * (top + height - bottom), escaped(plot.y_label));
  return out;
}

}  // namespace feedtwin::tools
