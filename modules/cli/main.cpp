#include <CLI/CLI.hpp>

#include "cli/front/run_cli.hpp"
#include "cli/verbs/commands.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): CLI11 throws when two options have one name, tests see that
int main(int argc, char** argv) {
  int exit_code = 0;
  CLI::App cli("PRIAMOS: an LCM robot stack whose operator link is 960 bytes per second", "priamos");
  priamos::cli::AddCommands(cli, exit_code);
  return priamos::cli::RunCli(cli, argc, argv, exit_code);
}
