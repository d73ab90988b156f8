#include <CLI/App.hpp>

#include "cli/options/verb_setup.hpp"
#include "cli/verbs/log/commands.hpp"

namespace priamos::cli {

void AddLogCommand(CLI::App& cli, int& exit_code) {
  auto* log = AddVerb(cli, "log", "Record, play, look into, mend and convert LCM logs.");
  log->require_subcommand(1);
  AddLogFileVerbs(*log, exit_code);
  AddLogRecordVerb(*log, exit_code);
  AddLogPlayVerb(*log, exit_code);
}

}  // namespace priamos::cli
