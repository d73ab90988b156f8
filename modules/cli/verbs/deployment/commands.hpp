#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `up`, `down`, `status` and `logs`, with the rules of verbs/commands.hpp.
void AddUpCommands(CLI::App& cli, int& exit_code);
/// The verb `restart`, likewise.
void AddRestartCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
