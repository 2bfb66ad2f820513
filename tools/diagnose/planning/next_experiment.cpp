#include "tools/diagnose/planning/next_experiment.h"

#include <fmt/format.h>

#include <algorithm>

#include "plant/effects/registry.h"
#include "tools/diagnose/planning/separation.h"
#include "tools/diagnose/screen.h"

namespace feedtwin::tools::diagnosis {
namespace {

constexpr std::size_t most_rivals = 3, asked_closely = 4;
constexpr double good_enough = 0.95;  // a dearer move is not looked for beyond it

Candidate without(const Candidate& model, std::string_view id) {
  Candidate less = model;
  std::erase_if(less.effects, [id](const Active& a) { return a.hypothesis->id == id; });
  return less;
}

Contender contender(const Fit& fit, const InverseModel& model) {
  const double inflation = std::max(1.0, fit.cost / static_cast<double>(model.rows()));
  return {fit.model, inflation * fit.covariance};
}

/// A pair of models that one move is to tell apart.
struct Question {
  Candidate truth;
  Contender other;
};

struct Answer {
  const Move* move = nullptr;
  double chance = 0.0;
};

bool about_a_process(const std::vector<Question>& questions) {
  const auto has = [](const Candidate& model) {
    return std::ranges::any_of(model.effects, [](const Active& a) { return told_id(*a.hypothesis) == "process_force"; });
  };
  return std::ranges::any_of(questions, [&has](const Question& q) { return has(q.truth) || has(q.other.model); });
}

/// Of the moves the first that answers every question well, else the best.
Answer best_move(const Separation& separation, const std::vector<Question>& questions,
                 const std::function<void(std::string_view)>& progress) {
  const auto least = [&](const Move& move, bool bent) {
    double chance = 1.0;
    for (const auto& q : questions)
      chance = std::min(chance, chance_to_tell(separation.distance(move, q.truth, q.other, bent)));
    return chance;
  };
  std::vector<Answer> promising;
  for (const auto& move : moves())
    if (move.process_runs || about_a_process(questions)) promising.push_back({&move, least(move, false)});
  std::ranges::stable_sort(promising, [](const Answer& a, const Answer& b) {
    return std::min(a.chance, good_enough) > std::min(b.chance, good_enough);
  });
  Answer best;
  for (std::size_t i = 0; i < std::min(asked_closely, promising.size()); ++i) {
    const Answer answer{promising[i].move, least(*promising[i].move, true)};
    progress(fmt::format("{}: tells with a chance of {:.2f} (numbers fixed: {:.2f})", answer.move->text, answer.chance,
                         promising[i].chance));
    if (best.move == nullptr || answer.chance > best.chance) best = answer;
    if (best.chance > good_enough) break;
  }
  return best;
}

/// Where a rival's own search starts, with the effect that it stands for taken out.
std::optional<Active> start_of(const Evidence& seen, const Fit& less, const Active& effect, const Hypothesis& rival,
                               std::vector<Score>& scores) {
  if (rival.id == effect.hypothesis->always_beside) {  // the same law under another name
    Active same{&rival, effect.q};
    for (std::size_t j = 0; j < same.q.size(); ++j)
      same.q[j] = std::clamp(same.q[j], rival.parameters[j].lowest, rival.parameters[j].highest);
    return same;
  }
  if (scores.empty()) scores = screen(seen.fitter, less, seen.whitening).scores;
  const auto own = std::ranges::find(scores, &rival, &Score::hypothesis);
  if (own == scores.end()) return std::nullopt;
  return at_zero(*own);
}

}  // namespace

NextExperiment plan_to_separate(const Evidence& seen, const Hypothesis& effect, const std::vector<std::string>& alternatives,
                                const std::function<void(std::string_view)>& progress) {
  NextExperiment next;
  next.separates = alternatives;
  next.separates.insert(next.separates.begin(), std::string(told_id(effect)));
  if (const auto* entry = plant::find_effect(effect.id)) next.move = entry->exciting_move;
  const auto own = std::ranges::find(seen.model.effects, &effect, &Active::hypothesis);
  if (own == seen.model.effects.end()) return next;
  const InverseModel& inverse = seen.fitter.model();
  const Fit less = seen.fitter.fit(without(seen.model, effect.id), seen.whitening, refit_iterations);
  const Separation separation(seen.forward, seen.fitter, seen.model, seen.data.controller);
  std::vector<Score> scores;
  std::vector<Question> questions;
  for (const auto& id : alternatives) {
    if (questions.size() == most_rivals) break;
    const auto start = start_of(seen, less, *own, hypothesis(id), scores);
    if (!start) continue;
    Candidate rival = less.model;
    rival.effects.push_back(*start);
    questions.push_back({seen.model, contender(seen.fitter.fit(rival, seen.whitening, refit_iterations), inverse)});
  }
  if (questions.empty()) return next;
  const Answer best = best_move(separation, questions, progress);
  next.move = best.move->text;
  next.p_resolve = best.chance;
  return next;
}

NextExperiment plan_to_prove(const Evidence& seen, const std::vector<Candidate>& suspects,
                             const std::function<void(std::string_view)>& progress) {
  NextExperiment next;
  if (suspects.empty()) return next;
  for (const auto& with : suspects) next.separates.emplace_back(told_id(*with.effects.back().hypothesis));
  const Fit present = seen.fitter.linearised(seen.model, seen.whitening);
  const Separation separation(seen.forward, seen.fitter, seen.model, seen.data.controller);
  const Answer best = best_move(separation, {{suspects.front(), contender(present, seen.fitter.model())}}, progress);
  next.move = best.move->text;
  next.p_resolve = best.chance;
  return next;
}

}  // namespace feedtwin::tools::diagnosis
