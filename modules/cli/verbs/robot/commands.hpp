#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `mission`, `where`, `place`, `map`, `param` and `view`, with the rules of verbs/commands.hpp.
void AddMissionCommand(CLI::App& cli, int& exit_code);
void AddWhereCommand(CLI::App& cli, int& exit_code);
void AddPlaceCommand(CLI::App& cli, int& exit_code);
void AddMapCommand(CLI::App& cli, int& exit_code);
void AddParamCommand(CLI::App& cli, int& exit_code);
void AddViewCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
