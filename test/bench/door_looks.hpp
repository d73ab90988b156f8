#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "head/core/head_model.hpp"
#include "head/core/landmark.hpp"
#include "world/core/renderer.hpp"
#include "world/world_loading.hpp"

namespace priamos::bench {

/// A specimen of KASTOR, and what its own calibration made of it: the reference object stood a little wrong,
/// motors and disc centres had their noise.
struct CalibratedHead {
  world::HeadBuild build;
  head::HeadModel model;
  Eigen::Isometry3d misplacement = Eigen::Isometry3d::Identity();  ///< from where the object should stand
};

/// Calibrates specimen `seed` as priamos-head does, around the zoom of the looks; throws std::runtime_error
/// if that fails. With `exactly_placed` all other errors are the same.
CalibratedHead CalibrateSpecimen(std::uint64_t seed, bool exactly_placed = false);

/// What is wrong with the scene, or nothing.
enum class Trouble { kNone, kDoorAbsent, kAnotherDoor, kHalfHidden, kLeafMoved, kLightsOut };
inline constexpr Trouble kTroubles[] = {Trouble::kDoorAbsent, Trouble::kAnotherDoor, Trouble::kHalfHidden,
                                        Trouble::kLeafMoved, Trouble::kLightsOut};
const char* Describe(Trouble trouble);

/// One stereo pair with all that is known of it.
struct DoorLook {
  std::array<cv::Mat, 2> images;
  std::array<head::CameraModel, 2> calibrated, exact;
  head::HeadSetting setting;  ///< of the motors
  Pose2 truth, believed;      ///< base_from_landmark
  bool door_is_there = true;
  double leaf_open_deg = 0;         ///< as it stands, Trouble::kLeafMoved only
  head::LandmarkModel model;        ///< as given to the finder: every edge off by the tolerance
  head::LandmarkModel exact_model;  ///< as built
  Eigen::Matrix<double, 6, 6> base_covariance;
};

/// The model of a map that tells the leaf's angle.
head::LandmarkModel ModelWithLeaf(double open_deg);

/// Tolerances that are drawn, and that the finder is told.
struct DoorTolerances {
  double model_sigma_m = 0.001, tilt_sigma_m = 0.00025;
};

/// Draws stereo pairs of the door of config/sim/worlds/door.toml, 2.4 m before the head, believed wrong by up
/// to 20 cm and 5 degrees; the robot drives on during the exposure. Furniture, light, textures, noise and the
/// leaf's angle follow the seed.
class DoorPhotographer {
 public:
  DoorPhotographer();
  /// `side` of the landmark at which the head looks, as in look_request_t; all else goes with the seed.
  DoorLook Take(std::uint64_t seed, Trouble trouble, const CalibratedHead& head,
                const DoorTolerances& tolerances = {}, int side = 0);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
