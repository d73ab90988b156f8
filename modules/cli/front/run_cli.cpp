#include "cli/front/run_cli.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>

#include "bus/command_line.hpp"

namespace priamos::cli {

int RunCli(CLI::App& cli, int argc, char** argv, const int& exit_code) {
  constexpr int kCannotStart = 2;
  try {
    if (const auto code = bus::ParseCommandLine(cli, argc, argv)) return *code;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << bus::FullName(bus::ChosenVerb(cli)) << ": " << error.path1().string() << ": "
              << error.code().message() << "; next: choose another place, or mend the rights of this one\n";
    return kCannotStart;
  } catch (const std::exception& error) {
    std::cerr << bus::FullName(bus::ChosenVerb(cli)) << ": " << error.what() << "\n";
    return kCannotStart;
  }
  return exit_code;
}

}  // namespace priamos::cli
