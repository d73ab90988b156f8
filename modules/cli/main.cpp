#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/front/run_cli.hpp"

int main(int argc, char** argv) {
  int exit_code = 0;
  CLI::App cli("PRIAMOS: an LCM robot stack whose operator link is 960 bytes per second", "priamos");
  cli.require_subcommand(1);
  priamos::cli::AddRunCommand(cli, exit_code);
  priamos::cli::AddLockstepCommand(cli, exit_code);
  priamos::cli::AddCalibrateCommand(cli, exit_code);
  priamos::cli::AddTopicCommand(cli, exit_code);
  priamos::cli::AddLogCommand(cli, exit_code);
  priamos::cli::AddReplayCommand(cli, exit_code);
  priamos::cli::AddTypeCommand(cli, exit_code);
  priamos::cli::AddDoctorCommand(cli, exit_code);
  priamos::cli::AddSeeCommand(cli, exit_code);
  priamos::cli::AddLinkCommand(cli, exit_code);
  priamos::cli::AddViewCommand(cli, exit_code);
  priamos::cli::AddUpCommands(cli, exit_code);
  priamos::cli::AddEstopCommand(cli, exit_code);
  priamos::cli::AddCompletionCommand(cli, exit_code);
  return priamos::cli::RunCli(cli, argc, argv, exit_code);
}
