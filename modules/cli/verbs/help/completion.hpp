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

/// What makes a shell ask `priamos completion words ...`; each is what `cmake --install` puts where that
/// shell looks, and what a person may load by hand.
std::string BashCompletion();
std::string ZshCompletion();
std::string FishCompletion();

}  // namespace priamos::cli
