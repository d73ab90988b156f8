#pragma once

#include <optional>
#include <string>

#include "common/frame_store.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/floor/obstacle_lines.hpp"

namespace priamos::head {

/// Evaluation of one picture of the laser's line.
struct FloorResult {
  ObstacleLines lines;                        ///< floor and obstacles, base frame
  std::optional<ObstaclePiece> new_obstacle;  ///< the worst piece, if the picture before showed no obstacle
  bool lines_lost = false;  ///< this is the last of kLostAfter pictures in a row in which no floor was judged
};

/// Evaluates pictures of the laser's line, one after the other: remembers whether the last one showed an
/// obstacle, and how many showed no line, so that each is reported once.
class FloorEvaluator {
 public:
  /// Pictures without a line after which they count as lost: more than a dark carpet that is driven over.
  static constexpr int kLostAfter = 40;

  FloorEvaluator(const HeadModel& head, const ObstacleOptions& options) : head_(head), finder_(options) {}

  /// The floor in a picture of the third camera, taken with the motors at `setting`. nullopt if the picture
  /// was lost, or laser or camera are not calibrated there.
  std::optional<FloorResult> Evaluate(const std::optional<GreyImage>& picture, const HeadSetting& setting);

 private:
  HeadModel head_;
  ObstacleFinder finder_;
  ObstacleLines::Verdict last_ = ObstacleLines::kClear;
  int blind_ = 0;  ///< pictures since the floor was judged last
};

/// The piece that is farthest above or below the floor; nullopt if there is none.
std::optional<ObstaclePiece> WorstPiece(const ObstacleLines& lines);

/// Text for a log: how far ahead of the base a piece is, and how high [m].
std::string Describe(const ObstaclePiece& piece);

}  // namespace priamos::head
