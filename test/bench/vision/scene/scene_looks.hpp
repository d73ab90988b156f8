#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/frame_store.hpp"
#include "test/bench/vision/landmark_looks.hpp"
#include "test/bench/vision/scene/eyes.hpp"

namespace priamos::bench {

/// The front of a box as it is: the side that the head sees most squarely, base frame.
struct TrueFront {
  std::string name;
  Eigen::Vector2d left, right;
  double top_m = 0, depth_m = 0;
  bool is_to_be_found = false;  ///< both upright edges and the upper one can be seen in both pictures

  Eigen::Vector2d middle() const { return (left + right) / 2; }
};

/// One stereo pair, or three pictures, of a room with boxes in it.
struct SceneLook {
  std::array<GreyImage, 3> images;
  std::array<head::CameraModel, 3> calibrated;
  std::array<head::CameraModel, 2> exact;
  Pose2 map_from_base;
  std::vector<TrueFront> fronts;
  std::shared_ptr<const world::Lighting> scene;  ///< for asking what is really there

  Eyes eyes() const { return {exact, *scene, map_from_base, 5}; }
};

/// Takes pictures in made-up rooms and floors, 2.0 to 3.5 m before their door, of up to three boxes of any
/// size and direction that stand 1.2 to 4 m before the robot, beside what the generator strewed there.
class ScenePhotographer {
 public:
  ScenePhotographer();
  SceneLook Take(std::uint64_t seed, const CalibratedHead& head);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
