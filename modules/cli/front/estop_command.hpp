#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verb `estop`, with the rules of verbs/commands.hpp.
void AddEstopCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
