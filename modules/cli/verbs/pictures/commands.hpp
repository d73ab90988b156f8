#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `see`, `locate` and `calibrate`, with the rules of verbs/commands.hpp.
void AddSeeCommand(CLI::App& cli, int& exit_code);
void AddLocateCommand(CLI::App& cli, int& exit_code);
void AddCalibrateCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
