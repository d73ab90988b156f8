#include "head/core/look/floor_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::head {

std::optional<FloorResult> FloorEvaluator::Evaluate(const std::optional<GreyImage>& picture,
                                                    const HeadSetting& setting) {
  const auto camera = head_.CameraAt(setting, kThird);
  if (!picture || head_.lasers.empty() || !camera) return std::nullopt;
  FloorResult result;
  result.lines = finder_.Find(*picture, *camera, head_.lasers);
  if (result.lines.verdict == ObstacleLines::kObstacle && last_ != ObstacleLines::kObstacle)
    result.new_obstacle = WorstPiece(result.lines);
  last_ = result.lines.verdict;
  blind_ = last_ == ObstacleLines::kBlind ? blind_ + 1 : 0;
  result.lines_lost = blind_ == kLostAfter;
  return result;
}

std::optional<ObstaclePiece> WorstPiece(const ObstacleLines& lines) {
  const auto worst = std::max_element(
      lines.pieces.begin(), lines.pieces.end(),
      [](const auto& a, const auto& b) { return std::abs(a.height_m) < std::abs(b.height_m); });
  if (worst == lines.pieces.end()) return std::nullopt;
  return *worst;
}

std::string Describe(const ObstaclePiece& piece) {
  return fmt::format("obstacle {:.1f} m ahead, {:+.3f} m against the floor", piece.left.x(), piece.height_m);
}

}  // namespace priamos::head
