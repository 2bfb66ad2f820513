#include "tools/machine/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <type_traits>

#include "tools/config/input_error.h"
#include "tools/machine/job_keys.h"
#include "tools/ranks/ranks.h"

namespace feedtwin::tools {
namespace {

constexpr std::size_t most_points = 1'000'000;

double number(const std::string& text, const std::string& sweep) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw InputError("--sweep " + sweep, 0, "", "expected KEY=FROM:TO:COUNT or KEY=A,B,C, found \"" + text + "\"");
  }
  return value;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<double> values_at(const std::vector<SweepAxis>& axes, std::size_t index) {
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0;) {
    values[i] = axes[i].values[index % axes[i].values.size()];
    index /= axes[i].values.size();
  }
  return values;
}

std::string what_went_wrong(const std::exception_ptr& failure) {
  if (!failure) return "";
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// Every rank gives its points to the others; point i is of rank i modulo their number.
void share(std::vector<SweepPoint>& points, const std::exception_ptr& failure, const Ranks& ranks) {
  static_assert(std::is_trivially_copyable_v<MachineTotals>, "it travels as bytes");
  if (ranks.size() == 1) {
    if (failure) std::rethrow_exception(failure);
    return;
  }
  for (const auto& error : ranks.gathered(what_went_wrong(failure))) {
    if (!error.empty()) throw InputError(error);
  }
  const auto stride = static_cast<std::size_t>(ranks.size());
  std::vector<MachineTotals> mine;
  for (auto i = static_cast<std::size_t>(ranks.rank()); i < points.size(); i += stride) mine.push_back(points[i].result);
  const auto parts = ranks.gathered(std::as_bytes(std::span(mine)));
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&points[i].result, parts[i % stride].data() + i / stride * sizeof(MachineTotals), sizeof(MachineTotals));
  }
}

}  // namespace

SweepAxis read_sweep_axis(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("--sweep " + text, 0, "", "expected KEY=FROM:TO:COUNT or KEY=A,B,C");
  SweepAxis axis{text.substr(0, equals), {}};
  const std::string range = text.substr(equals + 1);
  const auto parts = split(range, ':');
  if (parts.size() == 3) {
    const double from = number(parts[0], text), to = number(parts[1], text), count = number(parts[2], text);
    if (count < 2.0 || count > 1e6 || count != std::floor(count))
      throw InputError("--sweep " + text, 0, "", "expected 2 to 1e6 values");
    for (int i = 0; i < static_cast<int>(count); ++i) axis.values.push_back(from + (to - from) * i / (count - 1.0));
  } else {
    for (const auto& part : split(range, ',')) axis.values.push_back(number(part, text));
  }
  return axis;
}

std::vector<SweepPoint> run_sweep(const MachineJob& job, const std::vector<SweepAxis>& axes, unsigned threads) {
  std::size_t count = 1;
  for (const auto& axis : axes) {
    count *= axis.values.size();
    if (count > most_points) throw InputError("--sweep", 0, "", "more than a million points");
  }
  const Ranks& ranks = Ranks::world();
  const auto rank = static_cast<std::size_t>(ranks.rank()), stride = static_cast<std::size_t>(ranks.size());
  std::vector<SweepPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) points[i].values = values_at(axes, i);
  std::atomic<std::size_t> next = rank, done = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    for (std::size_t i = next.fetch_add(stride); i < count; i = next.fetch_add(stride)) {
      try {
        MachineJob point = job;
        for (std::size_t a = 0; a < axes.size(); ++a) {
          apply_setting(point, fmt::format("{}={:.17g}", axes[a].key, points[i].values[a]));
        }
        points[i].result = run_machine(point);
      } catch (...) {
        const std::lock_guard lock(failing);
        if (!failure) failure = std::current_exception();
        next = count;
      }
      const std::size_t finished = stride * ++done;
      if (ranks.first() && count >= 20 && finished % std::max<std::size_t>(stride, count / 20) < stride)
        std::fprintf(stderr, "sweep: %zu of %zu\n", std::min(finished, count), count);
    }
  };
  std::vector<std::jthread> pool;
  for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  pool.clear();
  share(points, failure, ranks);
  return points;
}

SpecificEnergyFit fit_specific_energy(const std::vector<SweepPoint>& points) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto each = [&](auto take) {
    for (const auto& point : points) {
      const double mrr = point.result.removal_rate_m3_per_s() * 1e9;
      if (mrr > 0.0) take(1.0 / mrr, point.result.specific_energy_J_per_m3() * 1e-9);
    }
  };
  each([&](double inverse, double sec) {
    n += 1.0;
    x += inverse;
    y += sec;
    xx += inverse * inverse;
    xy += inverse * sec;
  });
  SpecificEnergyFit fit;
  const double spread = n * xx - x * x;
  if (n < 2.0 || spread <= 1e-9 * n * xx) return fit;
  fit.a_W = (n * xy - x * y) / spread;
  fit.b_J_per_mm3 = (y - fit.a_W * x) / n;
  double square = 0.0;
  each([&](double inverse, double sec) { square += std::pow(sec - fit.a_W * inverse - fit.b_J_per_mm3, 2); });
  fit.rms_J_per_mm3 = std::sqrt(square / n);
  fit.points = static_cast<std::size_t>(n);
  return fit;
}

}  // namespace feedtwin::tools
