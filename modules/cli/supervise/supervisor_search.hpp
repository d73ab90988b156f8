#pragma once

#include <optional>
#include <string>

namespace priamos::cli {

/// Who supervises a robot, as heard on its buses.
struct FoundSupervisor {
  std::string who;  ///< e.g. pid 12 on hall9, since 2026-11-22 06:31:12
  std::optional<std::string>
      log_root;  ///< where it keeps its state; none: on another computer, or of another user
};

/// Listens for half a second to what the supervisor of `robot` says on both buses. Nothing when none is
/// heard, and on a computer whose network has no way for the buses.
std::optional<FoundSupervisor> FindSupervisor(const std::string& robot);

/// For a person: where it is, and what to type.
std::string Describe(const FoundSupervisor& found, const std::string& robot);

}  // namespace priamos::cli
