#include "cli/front/run_cli.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace priamos::cli {

int RunCli(CLI::App& cli, int argc, char** argv, const int& exit_code) {
  constexpr int kCannotStart = 2;
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : kCannotStart;
  } catch (const std::exception& error) {
    std::cerr << "priamos: " << error.what() << "\n";
    return kCannotStart;
  }
  return exit_code;
}

}  // namespace priamos::cli
