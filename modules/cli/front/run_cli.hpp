#pragma once

namespace CLI {
class App;
}

namespace priamos::cli {

/// Exit code of a program that cannot do what it was asked for.
inline constexpr int kCannotStart = 2;

/// Parses the arguments and runs the verb they name. Returns the exit code of the program: what the verb left
/// in `exit_code`, 0 after help, 2 with one sentence on standard error for what cannot be used.
int RunCli(CLI::App& cli, int argc, char** argv, const int& exit_code);

}  // namespace priamos::cli
