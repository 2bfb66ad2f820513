#include "tools/machine/reproduction_page.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tools/machine/machine_figures.h"
#include "tools/report/page.h"

namespace feedtwin::tools {
namespace {

constexpr const char* style =
    "<style>.met{color:#2e8540}.missed{color:#c2491d;font-weight:bold}.why{color:var(--soft);font-size:.8rem}"
    "#numbers td{white-space:normal;vertical-align:top}td.n{text-align:right}</style>";

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

Figure figure_11(const Reproduction& r) {
  Figure figure = sweep_figures(r.sweep, r.fit).front();
  figure.title =
      fmt::format("Fig. 11: SEC = {:.2f} / MRR + {:.3f}; the source: 37.5 / MRR + 3.008", r.fit.a_W, r.fit.b_J_per_mm3);
  FigureSeries source{"Eq. 15", {}, {}, false};
  for (int i = 10; i <= 100; ++i) {
    const double mrr = 0.1 * i;
    source.x.push_back(mrr);
    source.y.push_back(37.5 / mrr + 3.008);
  }
  figure.series.push_back(std::move(source));
  return figure;
}

}  // namespace

std::string reproduction_page(const Reproduction& r) {
  std::string above = style;
  above +=
      "<p>One configuration makes every number. Those marked are to be met within 5 %.</p>"
      "<section "
      "id=\"numbers\"><table><tr><th>where</th><th>quantity</th><th>source</th><th>here</th><th></th><th></th></tr>\n";
  auto to = std::back_inserter(above);
  for (const auto& n : r.numbers) {
    const bool met = std::abs(n.deviation()) <= 0.05;
    fmt::format_to(
        to,
        "<tr><td>{}</td><td>{}<div class=\"why\">{}</div></td><td class=\"n\">{:.4g}</td><td class=\"n\">{:.4g} {}</td>"
        "<td class=\"n\">{:+.1f} %</td><td class=\"{}\">{}</td></tr>\n",
        escaped(n.where), escaped(n.quantity), escaped(n.reason), n.source, n.ours, escaped(n.unit), 100.0 * n.deviation(),
        met ? "met" : "missed", n.target ? (met ? "met" : "missed") : "");
  }
  above += "</table></section><h2>What the source leaves open, and what was chosen</h2><ul>";
  for (const auto& choice : free_choices()) above += "<li>" + escaped(choice) + "</li>\n";
  above += "</ul><h2>Figures</h2>";

  auto figures = machine_figures(r.case_a, "Fig. 7, Fig. 8, case A: ");
  for (auto& figure : machine_figures(r.case_b, "Fig. 9, case B: ")) figures.push_back(std::move(figure));
  figures.push_back(figure_11(r));
  return page_with_figures("The source's numbers beside this program's", above, to_json(figures), figure_10(r));
}

}  // namespace feedtwin::tools
