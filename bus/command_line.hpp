#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace priamos::bus {

/// Exit code of a process that was asked for what it cannot do; nothing was begun.
inline constexpr int kCannotStart = 2;

/// Parses the arguments of a program and runs the callbacks of the verb they name. Adds `--version`, and to
/// every option that takes a number the check that it is one: no negative or overflowing count, no nan. Text
/// must not be empty, as `"$FILE"` is of a variable that is not set.
/// Returns the exit code when the command line was answered (0: help, version) or refused (2, with one
/// sentence on standard error); nothing when the program may go on.
std::optional<int> ParseCommandLine(CLI::App& cli, int argc, char** argv);

/// What was wrong, as one sentence: `priamos topic: unknown verb "lst"; nearest: "list" (priamos topic --help
/// lists all)`. `cli` is the app whose parsing threw `error`.
std::string Explain(const CLI::App& cli, const CLI::Error& error);

/// The verb that the parsed command line named: `list` of `priamos topic list`; `cli` itself when none.
const CLI::App& ChosenVerb(const CLI::App& cli);

/// Name of a verb as it is typed, e.g. `priamos topic list`.
std::string FullName(const CLI::App& verb);

/// The help of `verb`, with its full name.
std::string HelpOf(const CLI::App& verb);

}  // namespace priamos::bus
