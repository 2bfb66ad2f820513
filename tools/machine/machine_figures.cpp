#include "tools/machine/machine_figures.h"

#include <algorithm>
#include <functional>

namespace feedtwin::tools {
namespace {

using Value = std::function<double(const MachineSample&)>;

FigureSeries series(const MachineResult& r, const std::string& name, const Value& value) {
  std::vector<double> time_s, values;
  for (const auto& s : r.samples) {
    time_s.push_back(s.time_s);
    values.push_back(value(s));
  }
  return thinned(name, time_s, values);
}

FigureSeries energy(const MachineResult& r, const std::string& name, const Value& power_W) {
  double joules = 0.0, last_s = 0.0;
  return series(r, name, [&, power_W](const MachineSample& s) {
    joules += power_W(s) * (s.time_s - last_s);
    last_s = s.time_s;
    return joules;
  });
}

}  // namespace

std::vector<Figure> machine_figures(const MachineResult& r, const std::string& prefix) {
  const FigureAxis time{"time", "s"};
  struct Component {
    const char* name;
    Value power_W;
  };
  const Component components[] = {{"pump", [](const auto& s) { return s.power.pump_W; }},
                                  {"controller", [](const auto& s) { return s.power.controller_W; }},
                                  {"spindle", [](const auto& s) { return s.power.spindle_W; }},
                                  {"feed drives", [](const auto& s) { return s.power.feed_W; }},
                                  {"total", [](const auto& s) { return s.power.total_W(); }}};
  Figure powers{prefix + "power by component", time, {"power", "W"}, {}},
      energies{prefix + "energy by component", time, {"energy", "J"}, {}};
  for (const auto& c : components) {
    powers.series.push_back(series(r, c.name, c.power_W));
    energies.series.push_back(energy(r, c.name, c.power_W));
  }
  return {{prefix + "position",
           time,
           {"position", "m"},
           {series(r, "x", [](const auto& s) { return s.x_m; }), series(r, "y", [](const auto& s) { return s.y_m; })}},
          {prefix + "cutting force on the axes",
           time,
           {"force", "N"},
           {series(r, "x", [](const auto& s) { return s.force_x_N; }),
            series(r, "y", [](const auto& s) { return s.force_y_N; })}},
          {prefix + "contour error",
           time,
           {"distance", "m"},
           {series(r, "contour error", [](const auto& s) { return s.contour_error_m; })}},
          powers,
          energies};
}

std::vector<Figure> sweep_figures(const std::vector<SweepPoint>& points, const SpecificEnergyFit& fit) {
  if (fit.points == 0) return {};
  FigureSeries runs{"runs", {}, {}, true}, law{"fit a / MRR + b", {}, {}, false};
  for (const auto& p : points) {
    const double mrr = p.result.removal_rate_m3_per_s() * 1e9;
    if (mrr <= 0.0) continue;
    runs.x.push_back(mrr);
    runs.y.push_back(p.result.specific_energy_J_per_m3() * 1e-9);
  }
  const auto [low, high] = std::ranges::minmax(runs.x);
  for (int i = 0; i <= 100; ++i) {
    law.x.push_back(low + (high - low) * i / 100.0);
    law.y.push_back(fit.at(law.x.back()));
  }
  return {{"specific energy over removal rate", {"MRR", "mm3/s"}, {"SEC", "J/mm3"}, {runs, law}}};
}

}  // namespace feedtwin::tools
