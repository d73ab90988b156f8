#include "cli/scenario/story_registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace priamos::cli {

template <class... Story>
struct StoryList {
  static std::vector<StoryKind> Kinds() { return {KindOf<Story>()...}; }
};

/// One line per story: its class, which its own file defines.
using AllStories = StoryList<  //
    class CorridorStory,       //
    class DoorStory,           //
    class ElevatorStory,       //
    class ExploreStory,        //
    class GotoStory,           //
    class LocateStory,         //
    class PatrolStory,         //
    class TeleopStory>;

const std::vector<StoryKind>& Stories() {
  static const std::vector<StoryKind> kinds = AllStories::Kinds();
  return kinds;
}

const StoryKind& FindStory(std::string_view name) {
  const auto& kinds = Stories();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == name; });
  if (found == kinds.end()) throw std::invalid_argument(fmt::format("no story named {}", name));
  return *found;
}

}  // namespace priamos::cli
