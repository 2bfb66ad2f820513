// Makes one challenge case from a seed: tests/challenge/make runs it for a whole set and seals the keys.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "tests/challenge/challenge_case.h"

int main(int argc, char** argv) {
  using namespace feedtwin::challenge;
  CLI::App app("Makes a challenge case: a recording of a feed drive whose missing physics is known to the key alone.");
  Wish wish;
  std::string folder, key;
  bool list = false;
  app.add_option("FOLDER", folder, "of the case");
  app.add_option("KEY", key, "file of the key");
  app.add_option("--seed", wish.seed, "same seed, same case");
  app.add_option("--kind", wish.kind, "what is hidden")
      ->check(CLI::IsMember({"none", "numbers", "coloured", "single", "pair", "triple", "outside"}));
  app.add_option("--effect", wish.effect, "of kind single or outside: this one");
  app.add_option("--strength", wish.strength, "leftover of an effect over the leftover without it");
  app.add_flag("--list", list, "print the ids that can be hidden");
  CLI11_PARSE(app, argc, argv);
  try {
    if (list) {
      for (const auto& hidden : catalogue()) std::puts(hidden.id.c_str());
      return 0;
    }
    write_case(make_case(wish), wish.seed, folder, key);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
