#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace priamos::cli {

/// What the last of `words` may become: verbs and options of `cli` at that place, values an option or
/// argument is limited to, channel and type names where one is wanted. `words` is the command line without
/// the program's name; the last word may be empty. Empty when it is a file's turn: then the shell completes.
std::vector<std::string> Completions(const CLI::App& cli, const std::vector<std::string>& words);

/// The lines for ~/.bashrc that make bash ask `priamos completion words ...`.
std::string BashCompletion();

}  // namespace priamos::cli
