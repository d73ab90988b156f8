#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// All verbs of `priamos`, each from the commands.hpp of its room: a function adds one verb with its help;
/// the chosen verb leaves its exit code in `exit_code`: 0 for success, 1 for a run that did not succeed, 2
/// for something that cannot be used.
void AddCommands(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
