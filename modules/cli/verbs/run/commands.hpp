#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `run`, `lockstep`, `replay` and `report`, with the rules of verbs/commands.hpp.
void AddRunCommand(CLI::App& cli, int& exit_code);
void AddLockstepCommand(CLI::App& cli, int& exit_code);
void AddReplayCommand(CLI::App& cli, int& exit_code);
void AddReportCommand(CLI::App& cli, int& exit_code);
/// The verb `show` of `replay`.
void AddReplayShowVerb(CLI::App& replay, int& exit_code);

}  // namespace priamos::cli
