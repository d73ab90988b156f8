#include <CLI/App.hpp>

#include "cli/options/verb_setup.hpp"
#include "cli/verbs/log/commands.hpp"

// Apart from log_command.cpp: who links this does not link what needs a bus.
namespace priamos::cli {

void AddLogFileVerbs(CLI::App& log, int& exit_code) {
  AddLogInfoVerb(log, exit_code);
  AddLogIndexVerb(log, exit_code);
  AddLogFilterVerb(log, exit_code);
  AddLogExportVerb(log, exit_code);
  AddLogRepairVerb(log, exit_code);
  AddLogMergeVerb(log, exit_code);
}

void AddLogFileCommand(CLI::App& cli, int& exit_code) {
  auto* log = AddVerb(cli, "log", "Look into, mend and convert LCM logs.");
  log->require_subcommand(1);
  AddLogFileVerbs(*log, exit_code);
}

}  // namespace priamos::cli
