#pragma once

#include <string>

#include "common/time.hpp"

namespace priamos::cli {

/// What a person does in a scenario, and whether it came to a good end. The same in real time and in
/// lockstep.
class ScenarioStory {
 public:
  virtual ~ScenarioStory() = default;
  virtual void Tick(Time now) = 0;
  /// True when the story ended, or the time limit did it.
  virtual bool Done(Time now) const = 0;
  /// True when every process was alive and the person began.
  virtual bool Started() const = 0;
  virtual bool Succeeded() const = 0;
  /// The last words; what is missing while it has not begun.
  virtual std::string Reason() const = 0;
};

}  // namespace priamos::cli
