#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "robot/core/motion/path_shape.hpp"

namespace priamos::robot {

/// A straight piece of wall in the frame of the odometry, and how well its direction is known.
struct WallPiece {
  Eigen::Vector2d from{0, 0}, to{0, 0};
  double sigma_yaw_rad = 0.02;
};

/// Which walls are those of a corridor.
struct CorridorConfig {
  double parallel_deg = 10;  ///< angle between a wall and the course
  double ahead_m = 3;        ///< pieces farther ahead do not count ...
  double behind_m = 4;       ///< ... nor those farther behind
  double aside_m = 3;        ///< nor those farther beside the base
  double same_m = 0.12;      ///< pieces whose distances differ less are of one wall
  double loyalty_m = 1;      ///< length that counts for the wall that was followed so far
  double realign_s = 0.3;    ///< time between two looks at the walls
  double margin_m = 0.05;    ///< how far off the walls a detour keeps

  void Describe(Archive& a);
};

/// The middle line of a corridor, frame of the odometry.
struct CorridorAxis {
  Pose2 odom_from_axis;  ///< beside the base, x along the corridor
  /// Distance to either wall that is heard [m].
  std::optional<double> left_m{}, right_m{};
  double half_width_m = 0;  ///< as it was known last; 0: never
};

/// The axis between the walls beside a base that follows a corridor. On each side that wall counts of which
/// most length was heard: things that stand before a wall are shorter. With one wall the axis keeps half
/// the width from it that was known last, or where the base is when none was; with none it is the last one.
CorridorAxis FindAxis(const std::vector<WallPiece>& pieces, const Pose2& odom_from_base,
                      const CorridorAxis& last, const CorridorConfig& config);

/// A path along an axis, and where it begins beside the base; map frame.
struct CentredPath {
  Pose2 start;
  Path path;
};

/// What is left of a centred path, `to_go_m` along the axis. Its leeway ends before the walls, `body_m` being
/// half the width of the base.
CentredPath AlongAxis(const Path& ordered, const CorridorAxis& axis, const Pose2& map_from_odom,
                      double to_go_m, double body_m, const CorridorConfig& config);

/// Remembers the walls around the base, and follows the corridor that they are.
class CorridorGuide {
 public:
  explicit CorridorGuide(const CorridorConfig& config) : config_(config) {}

  /// Takes a wall that was found, or has grown; `number` names it.
  void Note(int number, const WallPiece& piece) { pieces_.insert_or_assign(number, piece); }
  /// Begins to follow a corridor in the direction `yaw_rad` [frame of the odometry].
  void Begin(const Pose2& odom_from_base, double yaw_rad);
  /// The axis by what is known now. Walls that lie behind are forgotten.
  const CorridorAxis& Follow(const Pose2& odom_from_base);

 private:
  CorridorConfig config_;
  std::map<int, WallPiece> pieces_;
  CorridorAxis axis_;
};

}  // namespace priamos::robot
