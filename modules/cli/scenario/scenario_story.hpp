#pragma once

#include <memory>
#include <string>

#include "cli/scenario/story_registry.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// After its end a run goes on so long, so that the last messages cross the radio and are recorded.
inline constexpr Duration kAftermath = std::chrono::milliseconds(1500);

/// What a person does in a scenario, and whether it came to a good end. The same in real time and in
/// lockstep. A story is a class in a file of its own with the constants kName, kSummary, kMovesMouse,
/// kSeeksDoor, kNeedsPlanner and kNeedsWaypoints (see StoryKind) and a constructor from a StoryStage; the
/// file ends with `template StoryKind KindOf<MyStory>();`, and story_registry.cpp has a line for the class.
class ScenarioStory {
 public:
  virtual ~ScenarioStory() = default;
  virtual void Tick(Time now) = 0;
  /// True when the story ended, or the time limit did it.
  virtual bool Done(Time now) const = 0;
  /// True when every process was alive and the person began.
  virtual bool Started() const = 0;
  virtual bool Succeeded() const = 0;
  /// Whether Succeeded() decides if the run has passed; if not, the record of the run does.
  virtual bool DecidesTheRun() const { return false; }
  /// The last words; what is missing while it has not begun.
  virtual std::string Reason() const = 0;
};

template <class Story>
StoryKind KindOf() {
  return {Story::kName,
          Story::kSummary,
          Story::kMovesMouse,
          Story::kSeeksDoor,
          Story::kNeedsPlanner,
          Story::kNeedsWaypoints,
          [](const StoryStage& stage) -> std::unique_ptr<ScenarioStory> {
            return std::make_unique<Story>(stage);
          }};
}

}  // namespace priamos::cli
