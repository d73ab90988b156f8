#include <CLI/App.hpp>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "bus/command_line.hpp"
#include "cli/options/verb_setup.hpp"
#include "cli/verbs/help/commands.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

const CLI::App& Find(const CLI::App& app, const std::string& name) {
  std::vector<std::string> known;
  for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (verb->get_name() == name) return *verb;
    known.push_back(verb->get_name());
  }
  throw std::runtime_error("unknown verb \"" + name + "\"" + NearestText(name, known));
}

}  // namespace

void AddHelpCommand(CLI::App& cli, int& exit_code) {
  auto words = std::make_shared<std::vector<std::string>>();
  auto* verb = AddVerb(cli, "help", "Help on a verb, or on all of them.");
  verb->footer("Example: priamos help topic list");
  verb->add_option("verb", *words, "the verb, and the verb of that");
  verb->callback([&cli, words, &exit_code] {
    const CLI::App* app = &cli;
    for (const std::string& word : *words) app = &Find(*app, word);
    std::cout << bus::HelpOf(*app);
    exit_code = 0;
  });
}

}  // namespace priamos::cli
