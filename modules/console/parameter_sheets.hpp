#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <string>

namespace priamos::console {

/// Parameters of every process of a deployment with units, ranges and meanings, by the process's name: what
/// `priamos-NAME --config FOLDER/NAME.toml --print-config` prints, from the Describe that reads the file. A
/// process that refuses its file gives its sentence, as a comment.
using ParameterSheets = std::map<std::string, std::string>;

/// Asks the processes in a thread of its own, once.
class ParameterQuestion {
 public:
  /// `programs`: the folder of the programs; `folder`: that of the deployment.
  void Ask(const std::filesystem::path& programs, const std::filesystem::path& folder);
  /// The answer, once, when all have given theirs.
  std::optional<ParameterSheets> Take();

 private:
  std::future<ParameterSheets> answer_;
  bool asked_ = false;
};

/// Asks them now and waits.
ParameterSheets AskForParameters(const std::filesystem::path& programs, const std::filesystem::path& folder);

}  // namespace priamos::console
