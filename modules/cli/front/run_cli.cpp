#include "cli/front/run_cli.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "bus/command_line.hpp"

namespace priamos::cli {

int RunCli(CLI::App& cli, int argc, char** argv, const int& exit_code) {
  constexpr int kCannotStart = 2;
  try {
    if (const auto code = bus::ParseCommandLine(cli, argc, argv)) return *code;
  } catch (const std::exception& error) {
    std::cerr << bus::FullName(bus::ChosenVerb(cli)) << ": " << error.what() << "\n";
    return kCannotStart;
  }
  return exit_code;
}

}  // namespace priamos::cli
