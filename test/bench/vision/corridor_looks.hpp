#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "test/bench/vision/corridor_plan.hpp"
#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// Which doors a robot may be asked to find in one stereo pair: the whole lintel in both pictures, and of
/// each jamb enough that a person would point at it.
struct ToBeFound {
  double min_range_m = 1.5, max_range_m = 6.0;  ///< from the head to the middle of the door
  double max_slant_deg = 70;                    ///< between the line of sight and the door's normal
  double border_px = 10;                        ///< the frame's upper corners are so far inside both pictures
  double jamb_m = 0.8;                          ///< visible of each jamb, at least ...
  double jamb_share = 0.7;                      ///< ... and so much of what the pictures' borders leave of it
  double lintel_share = 0.9;                    ///< visible of the lintel
};

/// Why a door is not to be found: it is not in both pictures.
inline constexpr const char* kOutOfThePicture = "out of the picture";

/// A door of the corridor as it is, seen from the robot.
struct TrueDoor {
  std::string name;
  Eigen::Vector2d left, right;  ///< jambs, base frame: the edges nearest to the robot beside the opening
  double height_m = 0;          ///< of the lintel there
  double frame_m = 0;           ///< from there to the frame's outer edge
  double range_m = 0, slant_deg = 0;
  double open_deg = 0;
  bool opens_to_us = false;
  bool is_to_be_found = false;
  std::string why_not;  ///< if it is not

  Eigen::Vector2d middle() const { return (left + right) / 2; }
};

/// One stereo pair, taken while driving.
struct CorridorLook {
  std::array<cv::Mat, 2> images;
  std::array<head::CameraModel, 2> calibrated, exact;
  std::vector<TrueDoor> doors;  ///< all before the robot
};

/// How the cameras are held.
enum class Hold {
  kOnTheRobot,  ///< as its head holds them; to be found are doors that both cameras see
  kInAHand,     ///< 1 to 1.5 m high, tilted by up to 8 and rolled by up to 2 degrees, told by nobody; to be
                ///< found are doors that the left camera sees. `calibrated` is right but for the base frame
};

/// Takes stereo pairs in corridors: the robot stands anywhere where it fits, turned by up to 10 degrees, and
/// drives on; the head looks ahead or up to 50 degrees to one side. Light, textures and noise as in world,
/// the head calibrated by itself with its errors.
class CorridorPhotographer {
 public:
  CorridorPhotographer();
  /// `looks` pairs of one corridor; every second one where at least one door is to be found, if there is such
  /// a place, the others wherever the robot happens to be.
  std::vector<CorridorLook> Take(std::uint64_t seed, int looks, const CalibratedHead& head,
                                 const ToBeFound& rule = {}, Hold hold = Hold::kOnTheRobot);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
