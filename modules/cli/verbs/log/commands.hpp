#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verb `log`, with the rules of verbs/commands.hpp.
void AddLogCommand(CLI::App& cli, int& exit_code);

/// The verbs of `log` that need a bus.
void AddLogRecordVerb(CLI::App& log, int& exit_code);
void AddLogPlayVerb(CLI::App& log, int& exit_code);

}  // namespace priamos::cli
