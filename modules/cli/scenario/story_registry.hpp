#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bus/node.hpp"
#include "common/serial_port.hpp"
#include "common/time.hpp"

namespace priamos::cli {

struct Scenario;
class ScenarioStory;

/// Where a story takes place, in real time or in lockstep.
struct StoryStage {
  const Scenario& scenario;
  std::uint64_t seed;
  bus::Node &onboard, &offboard;
  /// Opens the hand's end of the emulated space-mouse's cable.
  std::function<std::unique_ptr<ByteStream>()> open_mouse;
  /// Gets a line per thing that happens.
  std::function<void(Time, const std::string&)> progress;
};

/// What is known of a story before it begins.
struct StoryKind {
  std::string_view name;     ///< the word in a scenario file
  std::string_view summary;  ///< what the person does, in a few words
  bool moves_mouse;          ///< needs StoryStage::open_mouse
  bool seeks_door;           ///< needs the scenario's door in the ground plan
  bool needs_planner;        ///< gives its orders to the planner
  bool needs_waypoints;      ///< its orders lead to the scenario's waypoints: one at least
  std::unique_ptr<ScenarioStory> (*make)(const StoryStage& stage);
};

/// Every story that a scenario can name.
const std::vector<StoryKind>& Stories();

/// Story of this name. Throws std::invalid_argument for an unknown name, which no loaded scenario has.
const StoryKind& FindStory(std::string_view name);

/// The kind that a story class describes. Defined in scenario_story.hpp and instantiated by the story's own
/// file, so that the registry need not see the class.
template <class Story>
StoryKind KindOf();

}  // namespace priamos::cli
