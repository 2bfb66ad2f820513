#include "tools/diagnose.h"

#include <fmt/core.h>

#include <chrono>
#include <memory>

#include "tools/diagnose/screen.h"
#include "tools/recording/case.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {
using namespace diagnosis;
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
void show(const Fitter& f, const Fit& fit, const Whitening& w) {
  fmt::print("  cost {:.0f} rows {} prior {:.1f}; rms", fit.cost, f.model().rows(),
             fit.white.tail(fit.base_count()).squaredNorm());
  for (std::size_t e = 0; e < f.model().equations().size(); ++e) {
    double s = 0, n = 0;
    for (auto& g : f.model().segments())
      if (g.equation == e) s += fit.residual.segment(g.start, g.size).squaredNorm(), n += double(g.size);
    fmt::print(" {}={:.4g}({:.4g})", f.model().equations()[e].name, std::sqrt(s / n), w.residual_rms(e));
  }
  fmt::print("\n");
  for (auto& a : fit.model.effects) {
    fmt::print("    {}:", a.hypothesis->id);
    for (auto& v : a.hypothesis->named(a.q, fit.model.axis)) fmt::print(" {}={:.6g}", v.name, v.value);
    fmt::print("\n");
  }
}
int run(const std::string& path) {
  const Case c = read_case(path);
  std::vector<Track> tracks;
  for (auto& r : c.fit) {
    tracks.push_back(make_track(r, c.axis));
    tracks.back().run = tracks.size() - 1;
  }
  const InverseModel model(std::move(tracks), c.axis);
  const Fitter fitter(model, c.axis);
  double t = now();
  Candidate at{c.axis, {}};
  Whitening w = Whitening::estimate(model, model.residual(c.axis, {}));
  Fit fit = fitter.fit_with_colour(at, w, 3, 4);
  fmt::print("{} base fit {:.2f}s\n", path, now() - t);
  show(fitter, fit, w);
  for (std::size_t i = 0; i < fitter.base().size(); ++i)
    if (std::abs(fitter.deviations(fit.model.axis)[Index(i)]) > 1.2)
      fmt::print("{}:{:.3f} ", fitter.base()[i].entry->key,
                 value_of(fitter.base()[i], fit.model.axis) / value_of(fitter.base()[i], c.axis));
  fmt::print("\n");
  for (int k = 0; k < 3; ++k) {
    t = now();
    const Screen s = screen(fitter, fit, w);
    fmt::print("  screen {:.2f}s chance median {:.1f} 99% {:.1f}\n", now() - t, s.chance[100], s.chance[196]);
    for (std::size_t i = 0; i < 6; ++i) {
      auto& x = s.scores[i];
      fmt::print("    {:24} gain {:10.1f} std {:8.1f} p {:.2g} share {:.3f} q", x.hypothesis->id, x.gain, x.standard,
                 s.p_false_alarm(x.standard), x.gain / fit.cost);
      for (double q : x.q) fmt::print(" {:.4g}", q);
      fmt::print("\n");
    }
    t = now();
    Fit best;
    bool first = true;
    for (std::size_t i = 0; i < 3; ++i) {
      Candidate next = fit.model;
      next.effects.push_back(at_zero(s.scores[i]));
      Fit f = fitter.fit(next, w, 6);
      fmt::print("   refit {} cost {:.0f}\n", s.scores[i].hypothesis->id, f.cost);
      if (first || f.cost < best.cost) best = f, first = false;
    }
    fit = fitter.fit_with_colour(best.model, w, 2, 4);
    fmt::print("  refits {:.2f}s\n", now() - t);
    show(fitter, fit, w);
  }
  return done;
}
}  // namespace

std::function<int()> prepare_diagnose(CLI::App& app) {
  auto path = std::make_shared<std::string>();
  app.add_option("CASE", *path, "folder of the case")->required();
  return [path] { return run(*path); };
}
}  // namespace feedtwin::tools
