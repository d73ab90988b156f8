// `priamos`: an e-stop at once, every other verb by priamos-verbs beside it. That one holds all modules, and
// loading its libraries takes longer than an e-stop may.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "cli/front/estop_command.hpp"
#include "cli/front/run_cli.hpp"

namespace {

constexpr int kCannotStart = 2;

int Estop(int argc, char** argv) {
  int exit_code = 0;
  CLI::App cli("PRIAMOS", "priamos");
  priamos::cli::AddEstopCommand(cli, exit_code);
  return priamos::cli::RunCli(cli, argc, argv, exit_code);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): CLI11 throws when two options have one name, tests see that
int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "estop") return Estop(argc, argv);
  const std::string verbs = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "priamos-verbs";
  execv(verbs.c_str(), argv);
  std::cerr << "priamos: " << verbs
            << ": expected the program of the other verbs, got: " << std::strerror(errno) << "\n";
  return kCannotStart;
}
