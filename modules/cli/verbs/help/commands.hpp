#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// The verbs `doctor` and `help`, with the rules of verbs/commands.hpp.
void AddDoctorCommand(CLI::App& cli, int& exit_code);
void AddHelpCommand(CLI::App& cli, int& exit_code);
/// The verb `completion`; after all others: it completes their names.
void AddCompletionCommand(CLI::App& cli, int& exit_code);
/// The verb `manual`; after all others: it describes them.
void AddManualCommand(CLI::App& cli, int& exit_code);

}  // namespace priamos::cli
