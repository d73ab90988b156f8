// `priamos`: an e-stop at once, every other verb by priamos-verbs beside it. That one holds all modules, and
// loading its libraries takes longer than an e-stop may, and more memory than a large log: priamos-log has
// the verbs of logs that need none of them.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>

#include "cli/front/estop_command.hpp"
#include "cli/front/run_cli.hpp"

namespace {

int Estop(int argc, char** argv) {
  int exit_code = 0;
  CLI::App cli("PRIAMOS", "priamos");
  priamos::cli::AddEstopCommand(cli, exit_code);
  return priamos::cli::RunCli(cli, argc, argv, exit_code);
}

/// The program beside this one.
std::string Beside(const char* name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

bool IsLogFileVerb(int argc, char** argv) {
  constexpr std::string_view kVerbs[] = {"info", "index", "filter", "export", "repair", "merge"};
  return argc > 2 && std::string_view(argv[1]) == "log" &&
         std::find(std::begin(kVerbs), std::end(kVerbs), argv[2]) != std::end(kVerbs);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): CLI11 throws when two options have one name, tests see that
int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "estop") return Estop(argc, argv);
  if (IsLogFileVerb(argc, argv)) execv(Beside("priamos-log").c_str(), argv);
  const std::string verbs = Beside("priamos-verbs");  // knows all verbs, also when priamos-log is not there
  execv(verbs.c_str(), argv);
  std::cerr << "priamos: " << verbs
            << ": expected the program of the other verbs, got: " << std::strerror(errno) << "\n";
  return priamos::cli::kCannotStart;
}
