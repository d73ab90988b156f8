#pragma once

#include <span>

#include "head/core/landmark/edge_greys.hpp"
#include "head/core/landmark/landmark_fix.hpp"

namespace priamos::head {

/// What looks showed of one landmark beyond its model: where its edges lie, how broad it is, and the grey
/// values beside its edges.
class LandmarkMemory {
 public:
  explicit LandmarkMemory(const EdgeGreyOptions& greys = {}, bool keeps_greys = true)
      : grey_options_(greys), keeps_greys_(keeps_greys) {}

  /// Looks for the landmark as earlier looks saw it; or else, since light may have changed, without its
  /// greys; or else, since these looks may have seen something else, as the model has it. Remembers what this
  /// look shows. Greys without which it was found are forgotten at once, all the rest after three looks in a
  /// row that find it only as the model has it.
  LandmarkFix Find(const LandmarkFinder& finder, const LandmarkModel& model,
                   const LandmarkPrediction& expected, std::span<const CameraView> views);

  const EdgeGreys& greys() const { return greys_; }

 private:
  void Keep(const LandmarkModel& model, const LandmarkFix& fix, EdgeGreys before);

  EdgeGreyOptions grey_options_;
  bool keeps_greys_;
  ModelErrors errors_{};  ///< empty: nothing
  EdgeGreys greys_{};
  int contradicted_ = 0;  ///< looks in a row that found the landmark only without it
};

}  // namespace priamos::head
