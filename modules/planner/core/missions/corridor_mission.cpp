#include "planner/core/missions/corridor_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/learned/door_book.hpp"

namespace priamos::planner {
namespace {

constexpr double kMost_m = 180;  ///< as far as an order and the report of what is left reach
constexpr double kMap_m = 99.9;  ///< as far as a point of a path may lie from the origin of the map

/// A base that has come so far beyond what closes the corridor on the plan has not come there.
constexpr double kBeyond_m = 5;

/// How far a line leads before it leaves the map.
double LengthOnMap(const Pose2& from) {
  double length_m = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d direction = from.rotation().col(0);
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(direction(axis)) < 1e-9) continue;
    const double border = direction(axis) > 0 ? kMap_m : -kMap_m;
    length_m = std::min(length_m, (border - from.translation()(axis)) / direction(axis));
  }
  return length_m;
}

/// What the head has found since the order; empty when it found nothing, or does not look.
std::string DoorsOnTheWay(const MissionControl& control) {
  const auto& learned = control.heard().learned;
  const double since_s = static_cast<double>(ToUtime(control.started())) * 1e-6;
  const std::string doors = learned ? DoorsSeenSince(*learned, since_s) : "";
  return doors.empty() ? "" : "; " + doors;
}

}  // namespace

void CorridorMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "along the corridor"});
  a.Number("leeway_m", leeway_m, {"m", 0, 3.1, "how far its middle may be left around things"});
  a.Number("parallel_deg", parallel_deg, {"deg", 0, 45, "a wall of the plan less askew gives the direction"});
  a.Number("end_m", end_m, {"m", 0.5, 50, "ending so much earlier than on the plan it is closed"});
  a.Number("open_m", open_m, {"m", 2, 50, "its end is where no wall is beside the robot for so long"});
  a.Number("beside_m", beside_m,
           {"m", 0.5, 10, "what is farther from its middle is no wall of the corridor"});
  a.Number("patience_s", patience_s, {"s", 0, 600, "so long the way may be closed before its end"});
  a.Number("back_off_m", back_off_m, {"m", 0, 2, "so far the robot goes back to hear anew what closes it"});
  a.Number("back_off_m_s", back_off_m_s, {"m/s", 0.02, 0.5, "speed of that"});
  limits.Describe(a);
  a.Section("keep", keep, "looks on the way that keep the pose known");
}

CorridorMission::CorridorMission(const CorridorMissionConfig& config, const Footprint& footprint,
                                 const GroundPlan& plan)
    : config_(config), footprint_(footprint), faces_(FacesOf(plan)), keeper_(config.keep, plan) {}

std::optional<Refusal> CorridorMission::Start(const MissionOrder& order) {
  order_ = order;
  keeper_.Reset();
  if (order.distance_m >= 0 && order.distance_m <= kMost_m) return std::nullopt;
  return Refusal{fmt::format("a corridor is followed for 0 (to its end) to {:.0f} m", kMost_m)};
}

void CorridorMission::Step(MissionControl& control) {
  const Heard& heard = control.heard();
  if (control.state().phase == Phase::kWaiting) {
    if (heard.link_up && heard.pose && IsFresh(*heard.pose, control.now())) Depart(control);
    return;
  }
  keeper_.Step(control);
  driven_m_ = Driven_m(control);
  if (IsBesideWall(control)) beside_m_ = driven_m_;
  if (order_.distance_m == 0 && driven_m_ - beside_m_.value_or(0) > config_.open_m)
    return EndInTheOpen(control);
  if (end_m_ && driven_m_ > *end_m_ + kBeyond_m)
    return control.Fail(
        fmt::format("the wheels say {:.1f} m, and on the plan a wall closes the corridor after "
                    "{:.1f} m: do they turn while the base stands? next: look where it is, and "
                    "say so with priamos place",
                    driven_m_, *end_m_));
  const bool is_new = heard.pose->stamp > *control.path_sent();
  if (!is_new || !control.OnPath() || heard.drive->mode != DriveMode::kArrived) return;
  if (backs_off_) return Follow(control, length_m_ - driven_m_);
  control.Enter(Phase::kDone,
                fmt::format("followed the corridor for {:.1f} m in {:.0f} s{}", length_m_,
                            Seconds(control.now() - control.started()), DoorsOnTheWay(control)));
}

/// The heading that was ordered, else the base's; along the wall of the plan that is beside it there.
double CorridorMission::CourseFrom(const Pose2& base) const {
  const double ordered = order_.goal.turn ? order_.goal.map_from_base.yaw : base.yaw;
  const Eigen::Vector2d ahead(std::cos(ordered), std::sin(ordered));
  for (const WallFace& face : FacesAlong(faces_, {base.translation(), base.translation() + 2 * ahead})) {
    const double askew = std::remainder(std::atan2(face.along().y(), face.along().x()) - ordered, kPi);
    if (std::abs(askew) < Radians(config_.parallel_deg)) return WrapAngle(ordered + askew);
  }
  return ordered;
}

void CorridorMission::Depart(MissionControl& control) {
  const Pose2& base = control.heard().pose->map_from_base;
  const Pose2 course{base.x, base.y, CourseFrom(base)};
  const Eigen::Vector2d ahead = course.rotation().col(0);
  end_m_ = DistanceAhead(faces_, base.translation(), ahead);
  if (end_m_) *end_m_ = std::max(0.0, *end_m_ - footprint_.length_m / 2);
  const bool to_the_end = order_.distance_m == 0;
  length_m_ = std::min(to_the_end ? kMost_m : order_.distance_m, LengthOnMap(course));
  const double planned_m = std::min(length_m_, end_m_.value_or(length_m_));
  control.SendFaces(FacesAlong(faces_, {base.translation(), base.translation() + planned_m * ahead}));
  course_ = course;
  driven_m_ = 0;
  beside_m_.reset();
  closed_.reset();
  Follow(control, length_m_);
  control.Enter(Phase::kDriving, to_the_end ? "following the corridor to its end"
                                            : fmt::format("following the corridor for {:.1f} m", length_m_));
}

/// What is left is laid from where the robot is: it leads itself along the walls.
void CorridorMission::Follow(MissionControl& control, double length_m) {
  const Pose2& base = control.heard().pose->map_from_base;
  backs_off_ = false;
  PlannedPath path;
  path.points = {Pose2{base.x, base.y, course_.yaw} * Pose2{length_m, 0, 0}};
  path.leeway = {{config_.leeway_m, config_.leeway_m}};
  path.centre = true;
  control.OrderPath(std::move(path), config_.speed_m_s);
}

void CorridorMission::BackOff(MissionControl& control) {
  backs_off_ = true;
  PlannedPath path;
  path.points = {control.heard().pose->map_from_base * Pose2{-config_.back_off_m, 0, 0}};
  control.OrderPath(std::move(path), config_.back_off_m_s);
}

/// A report about another path than the one ordered last says nothing.
double CorridorMission::Driven_m(const MissionControl& control) const {
  if (backs_off_ || !control.OnPath()) return driven_m_;
  return std::max(0.0, length_m_ - control.heard().drive->remaining_m);
}

/// Whether the corridor should go on here.
bool CorridorMission::MayLeadOn() const {
  return order_.distance_m > 0 || !end_m_ || driven_m_ < *end_m_ - config_.end_m;
}

/// Where nothing leaves room for the base a corridor ends, unless it was to lead on: then it is looked at
/// again, in turn from here and from farther back.
void CorridorMission::OnStop(MissionControl& control, const Stop& stop) {
  if (stop.cause != Stop::Cause::kBlocked)
    return control.Fail(stop.reason + "; next: look what it is, and order it again");
  if (backs_off_) return Follow(control, length_m_ - driven_m_);  // something stands behind
  driven_m_ = Driven_m(control);
  if (!MayLeadOn()) return Close(control, stop);
  constexpr double kProgress_m = 0.5;
  if (!closed_ || driven_m_ > closed_->at_m + kProgress_m) closed_ = Closed{driven_m_, control.now()};
  if (Seconds(control.now() - closed_->since) >= config_.patience_s) return Close(control, stop);
  if (++closed_->n_looks % 2 == 0) BackOff(control);
}

/// Ends the mission where the way is closed.
void CorridorMission::Close(MissionControl& control, const Stop& stop) {
  if (order_.distance_m > 0)
    return control.Fail(fmt::format("the corridor is closed after {:.1f} of {:.1f} m: {}", driven_m_,
                                    order_.distance_m, stop.reason));
  if (end_m_ && MayLeadOn())
    return control.Fail(
        fmt::format("the corridor is closed after {:.1f} m, on the plan it ends after {:.1f} m: {}",
                    driven_m_, *end_m_, stop.reason));
  End(control, "at the end of the corridor");
}

/// Whether a wall that is known, of the plan or learned, goes along beside the robot.
bool CorridorMission::IsBesideWall(const MissionControl& control) const {
  const Pose2& base = control.heard().pose->map_from_base;
  const auto is_beside = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d along = to - from;
    const double askew = std::remainder(std::atan2(along.y(), along.x()) - course_.yaw, kPi);
    return std::abs(askew) < Radians(config_.parallel_deg) &&
           DistanceToSegment(from, to, base.translation()) < config_.beside_m;
  };
  const auto& learned = control.heard().learned;
  return std::ranges::any_of(faces_, [&](const WallFace& f) { return is_beside(f.from, f.to); }) ||
         (learned && std::ranges::any_of(learned->walls, [&](const LearnedWall& wall) {
            return is_beside(wall.from(), wall.to());
          }));
}

void CorridorMission::EndInTheOpen(MissionControl& control) {
  if (beside_m_) return End(control, "where the corridor opens");
  control.OrderPath({}, 0);
  control.Fail(fmt::format("no corridor: no wall was found beside the robot in {:.1f} m", driven_m_));
}

/// Followed to its end. What is left of the path is not to be driven later.
void CorridorMission::End(MissionControl& control, std::string_view where) {
  control.OrderPath({}, 0);
  control.Enter(Phase::kDone,
                fmt::format("{} after {:.1f} m in {:.0f} s{}", where, driven_m_,
                            Seconds(control.now() - control.started()), DoorsOnTheWay(control)));
}

}  // namespace priamos::planner
