#include "tools/diagnose/hypothesis.h"

#include <stdexcept>

#include "tools/diagnose/hypotheses/registry.h"

namespace feedtwin::tools::diagnosis {

const std::vector<Hypothesis>& hypotheses() {
  static const std::vector<Hypothesis> all = registered();
  return all;
}

const Hypothesis& hypothesis(std::string_view id) {
  for (const auto& one : hypotheses())
    if (one.id == id) return one;
  throw std::logic_error("no hypothesis " + std::string(id));
}

void add(Vector& sum, const Vector& more) {
  if (sum.size() == 0)
    sum = more;
  else
    sum += more;
}

void scale(Vector& factors, const Vector& more) {
  if (factors.size() == 0)
    factors = more;
  else
    factors = factors.cwiseProduct(more);
}

}  // namespace feedtwin::tools::diagnosis
