#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs of `priamos`. Each function adds one verb with its help; the chosen verb leaves its exit code in
/// `exit_code`: 0 for success, 1 for a run that did not succeed, 2 for something that cannot be used.
void AddRunCommand(CLI::App& cli, int& exit_code);
void AddLockstepCommand(CLI::App& cli, int& exit_code);
void AddCalibrateCommand(CLI::App& cli, int& exit_code);
void AddMissionCommand(CLI::App& cli, int& exit_code);
void AddWhereCommand(CLI::App& cli, int& exit_code);
void AddTopicCommand(CLI::App& cli, int& exit_code);
void AddLogCommand(CLI::App& cli, int& exit_code);
void AddReplayCommand(CLI::App& cli, int& exit_code);
void AddTypeCommand(CLI::App& cli, int& exit_code);
void AddDoctorCommand(CLI::App& cli, int& exit_code);
void AddSeeCommand(CLI::App& cli, int& exit_code);
void AddLinkCommand(CLI::App& cli, int& exit_code);
void AddViewCommand(CLI::App& cli, int& exit_code);
void AddUpCommands(CLI::App& cli, int& exit_code);  ///< up, down, status, logs
void AddHelpCommand(CLI::App& cli, int& exit_code);
/// Adds the verb that completes names of verbs; called after the functions of all verbs that it completes.
void AddCompletionCommand(CLI::App& cli, int& exit_code);
/// Adds the verb that prints the manual; called after the functions of all verbs that it describes.
void AddManualCommand(CLI::App& cli, int& exit_code);

/// Adds all verbs of `priamos`.
void AddCommands(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
