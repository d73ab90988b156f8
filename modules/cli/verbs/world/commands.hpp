#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verb `world`, with the rules of verbs/commands.hpp.
void AddWorldCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
