#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verb `log`, with the rules of verbs/commands.hpp.
void AddLogCommand(CLI::App& cli, int& exit_code);

/// The verb `log` of the program priamos-log: those that read and write files alone.
void AddLogFileCommand(CLI::App& cli, int& exit_code);
void AddLogFileVerbs(CLI::App& log, int& exit_code);

/// The verbs of `log` that read a log and write about it.
void AddLogInfoVerb(CLI::App& log, int& exit_code);
void AddLogIndexVerb(CLI::App& log, int& exit_code);
void AddLogExportVerb(CLI::App& log, int& exit_code);

/// The verbs of `log` that make one log of others.
void AddLogFilterVerb(CLI::App& log, int& exit_code);
void AddLogRepairVerb(CLI::App& log, int& exit_code);
void AddLogMergeVerb(CLI::App& log, int& exit_code);

/// The verbs of `log` that need a bus.
void AddLogRecordVerb(CLI::App& log, int& exit_code);
void AddLogPlayVerb(CLI::App& log, int& exit_code);

}  // namespace priamos::cli
