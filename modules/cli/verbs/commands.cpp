#include "cli/verbs/commands.hpp"

#include <CLI/App.hpp>

#include "cli/front/estop_command.hpp"
#include "cli/verbs/deployment/commands.hpp"
#include "cli/verbs/help/commands.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/mrpt/log_mrpt.hpp"
#include "cli/verbs/pictures/commands.hpp"
#include "cli/verbs/robot/commands.hpp"
#include "cli/verbs/run/commands.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "cli/verbs/world/commands.hpp"

namespace priamos::cli {

void AddCommands(CLI::App& cli, int& exit_code) {
  cli.require_subcommand(1);
  AddRunCommand(cli, exit_code);
  AddLockstepCommand(cli, exit_code);
  AddCalibrateCommand(cli, exit_code);
  AddMissionCommand(cli, exit_code);
  AddWhereCommand(cli, exit_code);
  AddPlaceCommand(cli, exit_code);
  AddMapCommand(cli, exit_code);
  AddParamCommand(cli, exit_code);
  AddTopicCommand(cli, exit_code);
  AddLogCommand(cli, exit_code);
  AddLogMrptVerb(*cli.get_subcommand("log"), exit_code);
  AddReplayCommand(cli, exit_code);
  AddReportCommand(cli, exit_code);
  AddTypeCommand(cli, exit_code);
  AddDoctorCommand(cli, exit_code);
  AddSeeCommand(cli, exit_code);
  AddLocateCommand(cli, exit_code);
  AddLinkCommand(cli, exit_code);
  AddWorldCommand(cli, exit_code);
  AddViewCommand(cli, exit_code);
  AddUpCommands(cli, exit_code);
  AddRestartCommand(cli, exit_code);
  AddEstopCommand(cli, exit_code);
  AddHelpCommand(cli, exit_code);
  AddCompletionCommand(cli, exit_code);
  AddManualCommand(cli, exit_code);
}

}  // namespace priamos::cli
