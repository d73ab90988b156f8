#pragma once

#include <string>

#include "cli/supervise/up_state.hpp"

namespace CLI {
class App;
}

namespace priamos::cli {

/// Exit code when what is asked about is not up, or did not come up.
inline constexpr int kNotThere = 1;

/// Adds the verbs `down`, `status` and `logs`: what one asks of a deployment that is up.
void AddUpQueries(CLI::App& cli, int& exit_code);

/// Adds the option `--logs`, the folder in which the state of an `up` is; left out it becomes the default one
/// when the command line was read. `log_root` must outlive `verb`.
void AddUpLogsOption(CLI::App& verb, std::string& log_root);

/// Prints the state of a deployment to standard output, as a table or as JSON.
void Show(const UpState& state, bool json);

}  // namespace priamos::cli
