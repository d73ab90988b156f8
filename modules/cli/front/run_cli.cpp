#include "cli/front/run_cli.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>

#include "bus/command_line.hpp"
#include "cli/front/standard_output.hpp"

namespace priamos::cli {

int RunCli(CLI::App& cli, int argc, char** argv, const int& exit_code) {
  StandardOutput output;
  const auto name = [&cli] { return bus::FullName(bus::ChosenVerb(cli)); };
  try {
    const auto answered = bus::ParseCommandLine(cli, argc, argv);
    return output.Finish(name(), answered.value_or(exit_code));
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << name() << ": " << error.path1().string() << ": " << error.code().message()
              << "; next: choose another place, or mend the rights of this one\n";
  } catch (const std::exception& error) {
    std::cerr << name() << ": " << error.what() << "\n";
  }
  return kCannotStart;
}

}  // namespace priamos::cli
