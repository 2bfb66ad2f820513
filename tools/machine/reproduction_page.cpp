#include "tools/machine/reproduction_page.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <iterator>

#include "tools/machine/plot.h"

namespace feedtwin::tools {
namespace {

constexpr const char* head =
    R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>Reproduction of the source's section 4</title>
<style>body{font:15px/1.45 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}table{border-collapse:collapse;width:100%}
td,th{border-bottom:1px solid #ddd;padding:3px 8px;text-align:left;vertical-align:top}td.n{text-align:right;white-space:nowrap}
.met{color:#2e7d32}.missed{color:#b71c1c;font-weight:bold}.why{color:#666;font-size:13px}svg{width:100%;margin:.4em 0}
.title{font:bold 14px sans-serif}.mark{font:11px sans-serif;text-anchor:middle;fill:#444}.end{text-anchor:end}
.name{font:12px sans-serif;text-anchor:end}.grid{stroke:#e4e4e4;fill:none}</style>
)";

using Value = std::function<double(const MachineSample&)>;

/// A column of the samples, each point the mean of a window (or its largest magnitude).
PlotLine column(const MachineResult& r, const std::string& name, const Value& value, double window_s, bool peak = false) {
  PlotLine line{name, {}, {}, false};
  double sum = 0.0, until_s = window_s;
  int count = 0;
  for (const auto& s : r.samples) {
    const double v = value(s);
    sum = peak ? (std::abs(v) > std::abs(sum) ? v : sum) : sum + v;
    ++count;
    if (s.time_s < until_s) continue;
    line.x.push_back(s.time_s);
    line.y.push_back(peak ? sum : sum / count);
    sum = 0.0;
    count = 0;
    until_s = s.time_s + window_s;
  }
  return line;
}

PlotLine cumulative(const MachineResult& r, const std::string& name, const Value& power_W) {
  PlotLine line{name, {}, {}, false};
  double joules = 0.0, last_s = 0.0;
  for (std::size_t i = 0; i < r.samples.size(); ++i) {
    joules += power_W(r.samples[i]) * (r.samples[i].time_s - last_s);
    last_s = r.samples[i].time_s;
    if (i % 50 != 0) continue;
    line.x.push_back(last_s);
    line.y.push_back(joules * 1e-3);
  }
  return line;
}

std::string figure_7(const MachineResult& r) {
  constexpr double window = 0.02;
  return svg({"Fig. 7: position of the table",
              "time, s",
              "mm",
              {column(
                   r, "x", [](const auto& s) { return s.x_m * 1e3; }, window),
               column(
                   r, "y", [](const auto& s) { return s.y_m * 1e3; }, window)}}) +
         svg({"Fig. 7: cutting force on the axes, largest in 20 ms",
              "time, s",
              "N",
              {column(
                   r, "x", [](const auto& s) { return s.force_x_N; }, window, true),
               column(
                   r, "y", [](const auto& s) { return s.force_y_N; }, window, true)}}) +
         svg({"Fig. 7: contour error, largest in 20 ms",
              "time, s",
              "um",
              {column(r, "contour error", [](const auto& s) { return s.contour_error_m * 1e6; }, window, true)}});
}

std::string power_and_energy(const std::string& title, const MachineResult& r) {
  const Value pump = [](const auto& s) { return s.power.pump_W; },
              controller = [](const auto& s) { return s.power.controller_W; },
              spindle = [](const auto& s) { return s.power.spindle_W; }, feed = [](const auto& s) { return s.power.feed_W; },
              total = [](const auto& s) { return s.power.total_W(); };
  constexpr double window = 0.1;
  return svg({title + ": power, mean of 0.1 s",
              "time, s",
              "W",
              {column(r, "pump", pump, window), column(r, "controller", controller, window),
               column(r, "spindle", spindle, window), column(r, "feed drives", feed, window)}}) +
         svg({title + ": energy",
              "time, s",
              "kJ",
              {cumulative(r, "pump", pump), cumulative(r, "controller", controller), cumulative(r, "spindle", spindle),
               cumulative(r, "feed drives", feed), cumulative(r, "total", total)}});
}

std::string figure_10(const Reproduction& r) {
  std::string out = "<h3>Fig. 10: energy by component, kJ</h3><table><tr><th></th><th>case A</th><th>case B</th></tr>";
  const auto row = [&](const std::string& name, double a, double b) {
    out +=
        fmt::format("<tr><td>{}</td><td class=\"n\">{:.4f}</td><td class=\"n\">{:.4f}</td></tr>", name, a * 1e-3, b * 1e-3);
  };
  const auto a = energy_by_component(r.case_a.energy), b = energy_by_component(r.case_b.energy);
  for (std::size_t i = 0; i < a.size(); ++i) row(a[i].first, a[i].second, b[i].second);
  row("<b>total</b>", r.case_a.energy.total_J(), r.case_b.energy.total_J());
  return out + "</table>";
}

std::string figure_11(const Reproduction& r) {
  PlotLine points{"this program", {}, {}, true}, ours{"its fit", {}, {}, false}, source{"Eq. 15", {}, {}, false};
  for (const auto& p : r.sweep) {
    points.x.push_back(p.result.removal_rate_m3_per_s() * 1e9);
    points.y.push_back(p.result.specific_energy_J_per_m3() * 1e-9);
  }
  for (double mrr = 1.0; mrr <= 10.0; mrr += 0.1) {
    ours.x.push_back(mrr);
    ours.y.push_back(r.fit.at(mrr));
    source.x.push_back(mrr);
    source.y.push_back(37.5 / mrr + 3.008);
  }
  return svg(
      {fmt::format("Fig. 11: SEC = {:.2f} / MRR + {:.3f}; the source: 37.5 / MRR + 3.008", r.fit.a_W, r.fit.b_J_per_mm3),
       "MRR, mm3/s",
       "SEC, J/mm3",
       {points, ours, source}});
}

}  // namespace

std::string reproduction_page(const Reproduction& r) {
  std::string out = head;
  out +=
      "<h1>The source's numbers beside this program's</h1><p>One configuration makes every number. Those marked are to be "
      "met "
      "within 5 %.</p><table><tr><th>where</th><th>quantity</th><th>source</th><th>here</th><th></th><th></th></tr>\n";
  auto to = std::back_inserter(out);
  for (const auto& n : r.numbers) {
    const bool met = std::abs(n.deviation()) <= 0.05;
    fmt::format_to(
        to,
        "<tr><td>{}</td><td>{}<div class=\"why\">{}</div></td><td class=\"n\">{:.4g}</td><td class=\"n\">{:.4g} {}</td>"
        "<td class=\"n\">{:+.1f} %</td><td class=\"{}\">{}</td></tr>\n",
        escaped(n.where), escaped(n.quantity), escaped(n.reason), n.source, n.ours, escaped(n.unit), 100.0 * n.deviation(),
        met ? "met" : "missed", n.target ? (met ? "met" : "missed") : "");
  }
  out += "</table><h2>What the source leaves open, and what was chosen</h2><ul>";
  for (const auto& choice : free_choices()) out += "<li>" + escaped(choice) + "</li>\n";
  out += "</ul><h2>Figures</h2>" + figure_7(r.case_a) + power_and_energy("Fig. 8, case A", r.case_a) +
         power_and_energy("Fig. 9, case B", r.case_b) + figure_10(r) + figure_11(r) + "</html>\n";
  return out;
}

}  // namespace feedtwin::tools
