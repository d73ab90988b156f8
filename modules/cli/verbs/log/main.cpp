// `priamos-log`: the verbs of `priamos log` that read and write files alone. The libraries of all other
// verbs, of which these need none, take more memory than a log of any size does.
#include <CLI/CLI.hpp>

#include "cli/front/run_cli.hpp"
#include "cli/verbs/log/commands.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): CLI11 throws when two options have one name, tests see that
int main(int argc, char** argv) {
  int exit_code = 0;
  CLI::App cli("PRIAMOS", "priamos");
  priamos::cli::AddLogFileCommand(cli, exit_code);
  return priamos::cli::RunCli(cli, argc, argv, exit_code);
}
