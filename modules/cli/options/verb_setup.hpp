#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <utility>

namespace priamos::cli {

/// A verb below `parent`, which owns it. A verb's file includes CLI/App.hpp and uses this instead of
/// App::add_subcommand: whoever makes an App compiles the formatter and the reader of configurations of
/// CLI11, seconds of work.
CLI::App* AddVerb(CLI::App& parent, const std::string& name, const std::string& description);

/// Completes a verb whose `options` have a flag `json`: the option --json, and `run`, which leaves its exit
/// code in `exit_code`, when the verb is chosen.
template <class Options>
void CompleteVerb(CLI::App& verb, std::shared_ptr<Options> options, int (*run)(const Options&),
                  int& exit_code, const std::string& json = "machine-readable") {
  verb.add_flag("--json", options->json, json);
  verb.callback([options = std::move(options), run, &exit_code] { exit_code = run(*options); });
}

}  // namespace priamos::cli
