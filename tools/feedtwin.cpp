// The program: feedtwin VERB ...

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>

#include "tools/config/input_error.h"
#include "tools/verb.h"

namespace feedtwin::tools {
namespace {

int run(int argc, char** argv) {
  CLI::App app{"feedtwin: a real-time plant for machine-tool feed drives, and what is missing from its model"};
  app.require_subcommand(1);
  std::function<int()> chosen;
  for (const auto& verb : verbs()) {
    auto* sub = app.add_subcommand(std::string(verb.name), std::string(verb.meaning));
    auto run = verb.prepare(*sub);
    sub->callback([run = std::move(run), &chosen] { chosen = run; });
  }
  try {
    app.parse(argc, argv);
    return chosen();
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "feedtwin: %s (see feedtwin --help)\n", error.what());
    return wrong_input;
  } catch (const InputError& error) {
    std::fprintf(stderr, "feedtwin: %s\n", error.what());
    return wrong_input;
  }
}

}  // namespace
}  // namespace feedtwin::tools

int main(int argc, char** argv) {
  try {
    return feedtwin::tools::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "feedtwin: internal error: %s\n", error.what());
    return feedtwin::tools::not_so;
  }
}
