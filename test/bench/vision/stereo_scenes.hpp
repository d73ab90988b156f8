#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "head/core/stereo/view_line.hpp"
#include "world/core/render/renderer.hpp"
#include "world/core/scene/world_plan.hpp"

namespace priamos::bench {

/// Where the three cameras stand.
enum class StereoScene { kDoorRoom, kCorridor, kBoxes };
inline constexpr StereoScene kStereoScenes[] = {StereoScene::kDoorRoom, StereoScene::kCorridor,
                                                StereoScene::kBoxes};
const char* Describe(StereoScene scene);

/// Rendered pictures of all three cameras (left, right, third) at one moment, and the scene they show.
struct StereoTriple {
  std::array<cv::Mat, 3> images;
  std::array<head::CameraModel, 3> cameras;  ///< exact
  std::vector<world::Solid> solids;
  Pose2 map_from_base;
  double ceiling_m = 2.8;

  /// Whether lines of two views are images of the same edge: the places of space that one of them shows, from
  /// the geometry that was drawn, lie on the other one. One way is enough: of a face that is seen edge-on,
  /// less than two pixels wide, nothing can be said in that image, but in the other one it is broad.
  bool IsSameEdge(const head::CameraView& first, int line, const head::CameraView& second, int other) const;
  /// How far beside each other they lie [px], median; infinite if nothing is known of the first line.
  double Beside(const head::CameraView& first, int line, const head::CameraView& second, int other) const;
};

/// Draws rooms with doors, a corridor with a row of equal doors, racks and boxes of equal shape: what repeats
/// is what is mistaken.
class StereoStage {
 public:
  StereoStage();
  StereoTriple Take(StereoScene scene, std::uint64_t seed);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
