#include "cli/options/verb_setup.hpp"

#include <CLI/CLI.hpp>

namespace priamos::cli {

CLI::App* AddVerb(CLI::App& parent, const std::string& name, const std::string& description) {
  return parent.add_subcommand(name, description);
}

}  // namespace priamos::cli
