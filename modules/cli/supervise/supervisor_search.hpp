#pragma once

#include <optional>
#include <string>

namespace priamos::cli {

/// Who supervises a robot, as heard on its buses.
struct FoundSupervisor {
  std::string who;  ///< e.g. pid 12 on hall9, since 2026-11-22 06:31:12
  /// Where it keeps its state; none: on another computer, or of another user.
  std::optional<std::string> log_root;
};

/// Listens for half a second for the supervisor of `robot` on both buses, by the interface `network` (empty:
/// as the route leads). Nothing if none is heard, or if the computer has no way for multicast.
std::optional<FoundSupervisor> FindSupervisor(const std::string& robot, const std::string& network);

/// Text for a person: where the supervisor runs, and what to type.
std::string Describe(const FoundSupervisor& found, const std::string& robot);

}  // namespace priamos::cli
