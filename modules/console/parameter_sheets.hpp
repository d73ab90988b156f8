#pragma once

#include <filesystem>
#include <future>
#include <map>
#include <optional>
#include <string>

#include "bus/parameters/parameter_json.hpp"

namespace priamos::console {

/// Parameters of a process with units, ranges and meanings, from the Describe that reads its file.
struct ProcessSheet {
  /// What `priamos-NAME --config FOLDER/NAME.toml --print-config` prints; when it refuses its file its
  /// sentence, as a comment.
  std::string text;
  /// What may be changed while it runs (`--print-parameters`).
  std::optional<bus::ParameterSheet> live{};
};

/// Those of every process of a deployment, by its name.
using ParameterSheets = std::map<std::string, ProcessSheet>;

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
