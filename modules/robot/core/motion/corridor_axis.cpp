#include "robot/core/motion/corridor_axis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::robot {
namespace {

constexpr double kForgotten_m = 12;  ///< a piece that lies so far off is no longer needed
constexpr double kLeast_m = 0.2;     ///< a shorter part of a piece tells nothing

/// The part of a piece that counts, in the frame of the axis.
struct Part {
  double at_m = 0;      ///< across the axis beside the base, positive to the left
  double length_m = 0;  ///< of what counts
  double turn_rad = 0;  ///< its direction against the axis
  double sigma_rad = 0;
};

/// The direction of a line, which has no sense, nearest to 0.
double LineAngle(double rad) {
  return std::remainder(rad, kPi);
}

std::optional<Part> PartOf(const WallPiece& piece, const Pose2& axis_from_odom,
                           const CorridorConfig& config) {
  const Eigen::Vector2d from = axis_from_odom * piece.from, to = axis_from_odom * piece.to;
  const double turn = LineAngle(std::atan2(to.y() - from.y(), to.x() - from.x()));
  if (std::abs(turn) > Radians(config.parallel_deg)) return std::nullopt;
  const double first = std::max(std::min(from.x(), to.x()), -config.behind_m);
  const double last = std::min(std::max(from.x(), to.x()), config.ahead_m);
  if (last - first < kLeast_m) return std::nullopt;
  // Beside the nearest place that was heard: a line is not carried on into the unknown.
  const Eigen::Vector2d middle = (from + to) / 2;
  const double beside = std::clamp(0.0, first, last);
  return Part{middle.y() + (beside - middle.x()) * std::tan(turn), last - first, turn, piece.sigma_yaw_rad};
}

/// Parts of one wall, and what speaks for it.
struct Group {
  std::vector<Part> parts;
  double at_m = 0, length_m = 0;
};

Group Joined(std::vector<Part> parts) {
  Group group{std::move(parts)};
  for (const Part& part : group.parts) {
    group.length_m += part.length_m;
    group.at_m += part.length_m * part.at_m;
  }
  group.at_m /= group.length_m;
  return group;
}

/// The wall on one side of which most was heard; `followed_m`: where the one followed so far should be.
std::optional<Group> WallAmong(std::vector<Part> parts, const std::optional<double>& followed_m,
                               const CorridorConfig& config) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.at_m < b.at_m; });
  std::optional<Group> best;
  double most = 0;
  for (auto begin = parts.begin(); begin != parts.end();) {
    const auto end =
        std::find_if(begin, parts.end(), [&](const Part& p) { return p.at_m - begin->at_m > config.same_m; });
    Group group = Joined({begin, end});
    const bool followed = followed_m && std::abs(group.at_m - *followed_m) < config.same_m;
    const double counts = group.length_m + (followed ? config.loyalty_m : 0);
    if (counts > most) {
      most = counts;
      best = std::move(group);
    }
    begin = end;
  }
  return best;
}

/// The direction of all parts together, weighed by how well each is known.
double TurnOf(const std::optional<Group>& left, const std::optional<Group>& right) {
  double weights = 0, sum = 0;
  for (const auto* group : {&left, &right}) {
    if (!*group) continue;
    for (const Part& part : (*group)->parts) {
      const double weight = 1 / (part.sigma_rad * part.sigma_rad + 1e-8);
      weights += weight;
      sum += weight * part.turn_rad;
    }
  }
  return weights > 0 ? sum / weights : 0;
}

/// The axis by the pieces as they lie to the last one.
CorridorAxis AxisFrom(const std::vector<WallPiece>& pieces, const Pose2& odom_from_base,
                      const CorridorAxis& last, const CorridorConfig& config) {
  // The last axis, begun beside the base.
  const Eigen::Vector2d base = last.odom_from_axis.Inverse() * odom_from_base.translation();
  const Pose2 odom_from_here = last.odom_from_axis * Pose2{base.x(), 0, 0};
  const Pose2 here_from_odom = odom_from_here.Inverse();
  std::vector<Part> left, right;
  for (const WallPiece& piece : pieces) {
    const auto part = PartOf(piece, here_from_odom, config);
    if (!part || std::abs(part->at_m - base.y()) > config.aside_m) continue;
    (part->at_m > base.y() ? left : right).push_back(*part);
  }
  const bool known = last.half_width_m > 0;
  const auto side = [&](int sign) { return known ? std::optional(sign * last.half_width_m) : std::nullopt; };
  const auto on_left = WallAmong(left, side(1), config), on_right = WallAmong(right, side(-1), config);

  CorridorAxis axis{odom_from_here, {}, {}, last.half_width_m};
  if (!on_left && !on_right) return axis;
  double middle_m = 0;
  if (on_left && on_right) {
    middle_m = (on_left->at_m + on_right->at_m) / 2;
    axis.half_width_m = (on_left->at_m - on_right->at_m) / 2;
  } else if (known) {
    middle_m = on_left ? on_left->at_m - last.half_width_m : on_right->at_m + last.half_width_m;
  } else {
    middle_m = base.y();
  }
  if (on_left) axis.left_m = on_left->at_m - middle_m;
  if (on_right) axis.right_m = middle_m - on_right->at_m;
  axis.odom_from_axis = odom_from_here * Pose2{0, middle_m, TurnOf(on_left, on_right)};
  return axis;
}

}  // namespace

void CorridorConfig::Describe(Archive& a) {
  a.Number("parallel_deg", parallel_deg, {"deg", 1, 30, "angle between a corridor's wall and the course"});
  a.Number("ahead_m", ahead_m, {"m", 0.5, 10, "walls farther ahead do not count"});
  a.Number("behind_m", behind_m, {"m", 0.5, 10, "walls farther behind do not count"});
  a.Number("aside_m", aside_m, {"m", 0.5, 5, "walls farther beside the base do not count"});
  a.Number("same_m", same_m, {"m", 0.02, 0.5, "pieces whose distances differ less are of one wall"});
  a.Number("loyalty_m", loyalty_m, {"m", 0, 10, "length that counts for the wall followed so far"});
  a.Number("realign_s", realign_s, {"s", 0.02, 5, "time between two looks at the walls"});
  a.Number("margin_m", margin_m, {"m", 0, 0.5, "how far off the walls a detour keeps"});
}

/// Twice: pieces ahead and behind lie beside each other only in the right direction.
CorridorAxis FindAxis(const std::vector<WallPiece>& pieces, const Pose2& odom_from_base,
                      const CorridorAxis& last, const CorridorConfig& config) {
  CorridorAxis turned = AxisFrom(pieces, odom_from_base, last, config);
  turned.odom_from_axis.x = last.odom_from_axis.x;
  turned.odom_from_axis.y = last.odom_from_axis.y;
  turned.half_width_m = last.half_width_m;
  return AxisFrom(pieces, odom_from_base, turned, config);
}

CentredPath AlongAxis(const Path& ordered, const CorridorAxis& axis, const Pose2& map_from_odom,
                      double to_go_m, double body_m, const CorridorConfig& config) {
  const Pose2 start = map_from_odom * axis.odom_from_axis;
  Path path = ordered;
  path.points = {start * Pose2{to_go_m, 0, 0}};
  if (path.leeway.size() == 1 && axis.half_width_m > 0) {
    const double room_m = std::max(0.0, axis.half_width_m - body_m - config.margin_m);
    Leeway& leeway = path.leeway.front();
    leeway = {std::min(leeway.left_m, room_m), std::min(leeway.right_m, room_m)};
  }
  return {start, std::move(path)};
}

void CorridorGuide::Begin(const Pose2& odom_from_base, double yaw_rad) {
  axis_ = {{odom_from_base.x, odom_from_base.y, yaw_rad}};
}

const CorridorAxis& CorridorGuide::Follow(const Pose2& odom_from_base) {
  const Eigen::Vector2d base = odom_from_base.translation();
  std::erase_if(pieces_, [&](const auto& piece) {
    return std::min((piece.second.from - base).norm(), (piece.second.to - base).norm()) > kForgotten_m;
  });
  std::vector<WallPiece> pieces;
  for (const auto& [number, piece] : pieces_) pieces.push_back(piece);
  axis_ = FindAxis(pieces, odom_from_base, axis_, config_);
  return axis_;
}

}  // namespace priamos::robot
