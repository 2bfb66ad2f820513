#include "tools/report/figure.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

namespace feedtwin::tools {
namespace {

/// Seven digits: more than a screen shows, and a third of the file.
nlohmann::json short_numbers(const std::vector<double>& values) {
  auto out = nlohmann::json::array();
  for (const double value : values) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 7).ptr;
    double rounded = value;
    std::from_chars(text, end, rounded);
    out.push_back(rounded);
  }
  return out;
}

}  // namespace

FigureSeries thinned(std::string name, std::span<const double> x, std::span<const double> y, std::size_t most_points) {
  FigureSeries series{std::move(name), {}, {}, false};
  const std::size_t n = std::min(x.size(), y.size());
  const std::size_t piece = std::max<std::size_t>(1, 4 * n / std::max<std::size_t>(most_points, 4));
  for (std::size_t first = 0; first < n; first += piece) {
    const std::size_t end = std::min(first + piece, n);
    const auto [low, high] =
        std::minmax_element(y.begin() + static_cast<std::ptrdiff_t>(first), y.begin() + static_cast<std::ptrdiff_t>(end));
    std::vector<std::size_t> keep{first, static_cast<std::size_t>(low - y.begin()),
                                  static_cast<std::size_t>(high - y.begin()), end - 1};
    std::ranges::sort(keep);
    keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
    for (const std::size_t i : keep) {
      series.x.push_back(x[i]);
      series.y.push_back(y[i]);
    }
  }
  return series;
}

nlohmann::json to_json(const Figure& figure) {
  nlohmann::json out{{"title", figure.title},
                     {"x", {{"label", figure.x.label}, {"unit", figure.x.unit}}},
                     {"y", {{"label", figure.y.label}, {"unit", figure.y.unit}}},
                     {"series", nlohmann::json::array()}};
  for (const auto& series : figure.series) {
    out["series"].push_back({{"name", series.name},
                             {"style", series.points ? "points" : "line"},
                             {"x", short_numbers(series.x)},
                             {"y", short_numbers(series.y)}});
  }
  return out;
}

nlohmann::json to_json(const std::vector<Figure>& figures) {
  auto out = nlohmann::json::array();
  for (const auto& figure : figures) out.push_back(to_json(figure));
  return out;
}

}  // namespace feedtwin::tools
