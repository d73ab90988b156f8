#include "robot/core/motion/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace priamos::robot {
namespace {

// Distance [m] that the base drives at most while a path comes over the radio.
constexpr double kPassedAtMost = 0.3;
constexpr double kNearPath_m = 0.3;
constexpr double kLookedAtEnd_m = 0.02;
// A base that stood within so much for so long before what closes its way looks for another one.
constexpr double kStays_m = 0.08, kStays_s = 1.5;
constexpr double kBackSpeed_m_s = 0.2, kBackEnd_m = 0.03, kHeldBack_s = 3;
// So often a base goes back before one dead end; beyond it by so much the next one begins.
constexpr int kMostBackOffs = 3;
constexpr double kBeyond_m = 0.7;
constexpr double kHeard_m = 2;  ///< nearer to a base what is there is heard

struct Begin {
  Pose2 start;
  Path path;
};

/// A path that took a while to arrive may begin with a point that the base has just passed. Then it begins
/// on its first line beside the base, so that the base need not go back and the line stays where it was.
Begin WithoutPassedPoint(const Path& path, const Pose2& pose) {
  if (path.points.size() < 2) return {pose, path};
  const Pose2 &first = path.points[0], &second = path.points[1];
  const Eigen::Vector2d line = second.translation() - first.translation();
  const Eigen::Vector2d delta = pose.translation() - first.translation();
  const double length = line.norm();
  if (length < kPassedAtMost) return {pose, path};
  const double passed = line.dot(delta) / length;
  const double beside = (delta - line * (passed / length)).norm();
  if (passed <= 0 || passed > kPassedAtMost || beside > kNearPath_m) return {pose, path};

  const double part = passed / length;
  const Eigen::Vector2d foot = first.translation() + line * part;
  Begin begin{{foot.x(), foot.y(), WrapAngle(first.yaw + part * WrapAngle(second.yaw - first.yaw))}, path};
  begin.path.points.erase(begin.path.points.begin());
  if (!begin.path.leeway.empty()) begin.path.leeway.erase(begin.path.leeway.begin());
  return begin;
}

/// Places [m] just before a base that stands in a dead end, across the direction of its path: no way leads
/// there, also when nobody hears any more what closes it.
std::vector<Eigen::Vector2d> BeforeBase(const Eigen::Vector2d& direction, const Pose2& base,
                                        const Footprint& footprint) {
  constexpr double kAhead_m = 0.05, kBeside_m = 0.3;
  const Eigen::Vector2d along = direction.normalized(), left(-along.y(), along.x());
  const Eigen::Vector2d seen = base.rotation().transpose() * along;
  const double front_m = seen.cwiseAbs().dot(footprint.Size() / 2) + kAhead_m;
  std::vector<Eigen::Vector2d> places;
  for (const double side : {-1.0, 0.0, 1.0})
    places.emplace_back(base.translation() + front_m * along + side * kBeside_m * left);
  return places;
}

}  // namespace

void PathFollowerConfig::Describe(Archive& a) {
  a.Number("gain_per_s", gain_per_s, {"1/s", 0.1, 10, "velocity towards the path per distance from it"});
  a.Number("turn_gain_per_s", turn_gain_per_s, {"1/s", 0.1, 10, "turn rate per heading error"});
  a.Number("correction_speed_m_s", correction_speed_m_s,
           {"m/s", 0.01, 1, "fastest velocity towards the path"});
  a.Number("correction_turn_rad_s", correction_turn_rad_s, {"rad/s", 0.01, 2, "fastest turn to the heading"});
  a.Number("arrival_m", arrival_m, {"m", 0.001, 0.2, "arrived when this near to the last point"});
  a.Number("arrival_deg", arrival_deg, {"deg", 0.05, 10, "and the heading is this near"});
  a.Number("latency_s", latency_s, {"s", 0, 0.5, "from a pose to wheels that obey it"});
  a.Number("aside_speed_m_s", aside_speed_m_s, {"m/s", 0.01, 1, "fastest velocity towards a detour"});
  a.Number("aside_m", aside_m, {"m", 0.01, 1, "so far from its detour the base does not go ahead"});
  a.Section("detour", detour, "how a path is left around things");
  a.Section("shape", shape, "how the points of a path become a curve with speeds");
}

void PathFollower::Follow(const Path& path, const Pose2& pose) {
  const Begin begin = WithoutPassedPoint(path, pose);
  shape_.emplace(config_.shape, begin.start, begin.path);
  detour_ = {};
  ForgetDeadEnds();
  ahead_ = pose;
  s_ = 0;
  speed_ = 0;
  arrived_ = false;
}

void PathFollower::Realign(const Path& path, const Pose2& start) {
  detour_ = detour_.From(s_);
  ForgetDeadEnds();
  shape_.emplace(config_.shape, start, path);
  s_ = 0;
}

void PathFollower::Avoid(std::span<const Eigen::Vector2d> heard, Time now) {
  if (!LooksAround(now)) return;
  const PathPlace here = Place();
  if (!seeks_) searched_ = now;
  if (back_off_) return EndBackOff(here, now);
  const std::vector<Eigen::Vector2d> things = WithKnown(heard);
  if (seeks_) return SeekOtherWay(here, things);
  driven_.Note(here);
  const Things taken = here.s < smaller_to_m_ ? Things::kSmaller : Things::kAsHeard;
  const auto detour = FindDetour(BeyondDeadEnds(here), footprint_, *shape_, here, things, detour_, taken);
  if (detour) detour_ = *detour;
  // Who takes things as smaller than they are heard may find out that they are not.
  const bool leads_on = detour && detour->leads_on() && taken == Things::kAsHeard;
  if (!IsInDeadEnd(here, leads_on, now)) return;
  stands_ = Stand{here, now};
  if (back_offs_ < kMostBackOffs)
    seeks_ = Things::kAsHeard;
  else
    ForgetClosed();
}

/// What is heard; what was known in the last dead end, where it is too far away now to be heard; and what
/// closes dead ends.
std::vector<Eigen::Vector2d> PathFollower::WithKnown(std::span<const Eigen::Vector2d> things) const {
  std::vector<Eigen::Vector2d> all(things.begin(), things.end());
  std::copy_if(known_.begin(), known_.end(), std::back_inserter(all), [&](const Eigen::Vector2d& thing) {
    return (thing - ahead_.translation()).norm() > kHeard_m;
  });
  all.insert(all.end(), closed_.begin(), closed_.end());
  return all;
}

/// A way that would end in a known dead end is to be found out where it begins.
DetourConfig PathFollower::BeyondDeadEnds(const PathPlace& here) const {
  DetourConfig config = config_.detour;
  if (!closed_.empty() && here.s < deepest_m_)
    config.horizon_m = std::max(config.horizon_m, deepest_m_ + kBeyond_m - here.s);
  return config;
}

/// Whether the base has stood on a line that may be left, before what closes it, and may go back once more.
bool PathFollower::IsInDeadEnd(const PathPlace& here, bool leads_on, Time now) {
  if (here.s > deepest_m_ + kBeyond_m) back_offs_ = 0;
  const Leeway leeway = shape_->LeewayAt(here.s);
  const bool may_leave = (leeway.any() && !leeway.narrow()) || std::abs(here.offset_m) > kStays_m;
  const bool may_go_back = back_offs_ < kMostBackOffs || !closed_.empty();
  const bool looks_for_one = !leads_on && !arrived_ && may_leave && may_go_back;
  if (!looks_for_one) stands_.reset();
  return looks_for_one && StandsFor(here, now) >= FromSeconds(kStays_s);
}

Duration PathFollower::StandsFor(const PathPlace& here, Time now) {
  const bool moved =
      !stands_ || std::hypot(here.s - stands_->at.s, here.offset_m - stands_->at.offset_m) > kStays_m;
  if (moved) stands_ = Stand{here, now};
  return now - stands_->since;
}

/// One search at a time: two would take too long for a step. Where none leads on, what was closed may be free
/// by now.
void PathFollower::SeekOtherWay(const PathPlace& here, std::span<const Eigen::Vector2d> things) {
  const Things taken = *std::exchange(seeks_, std::nullopt);
  const bool smaller = taken == Things::kSmaller, also_here = smaller && here.s >= smaller_to_m_;
  const auto other =
      FindOtherWay(config_.detour, footprint_, *shape_, here, things, driven_, taken, also_here);
  if (other) return TakeOtherWay(*other, here, things);
  if (!smaller)
    seeks_ = Things::kSmaller;
  else
    ForgetClosed();
}

void PathFollower::TakeOtherWay(const OtherWay& other, const PathPlace& here,
                                std::span<const Eigen::Vector2d> things) {
  ++back_offs_;
  deepest_m_ = std::max(deepest_m_, here.s);
  smaller_to_m_ = other.taken == Things::kSmaller ? here.s + kBeyond_m : -1;
  detour_ = other.onward;
  if (other.back_to_m > here.s - kBackEnd_m) return;
  detour_ = other.back;
  back_off_ = other;
  known_.assign(things.begin(), things.end() - static_cast<std::ptrdiff_t>(closed_.size()));
  const auto before = BeforeBase(shape_->At(here.s).direction, ahead_, footprint_);
  closed_.insert(closed_.end(), before.begin(), before.end());
}

void PathFollower::ForgetClosed() {
  closed_.clear();
  known_.clear();
}

void PathFollower::ForgetDeadEnds() {
  driven_.Clear();
  stands_.reset();
  seeks_.reset();
  back_off_.reset();
  smaller_to_m_ = -1;
  deepest_m_ = 0;
  ForgetClosed();
  back_offs_ = 0;
}

/// Where the other way branches off the base goes ahead again; also where something holds it on its way back.
void PathFollower::EndBackOff(const PathPlace& here, Time now) {
  const bool there = s_ < back_off_->back_to_m + kBackEnd_m;
  if (!there && StandsFor(here, now) < FromSeconds(kHeldBack_s)) return;
  if (there) detour_ = back_off_->onward;
  back_off_.reset();
  stands_.reset();
}

/// Wanted ds/dt; negative on the way back.
double PathFollower::PaceAt(double left_m) const {
  if (back_off_) return -std::min(kBackSpeed_m_s, s_ - back_off_->back_to_m + kBackEnd_m);
  return std::min(shape_->SpeedAt(s_), config_.turn_gain_per_s * left_m);
}

void PathFollower::LimitSpeeds(const PathShapeConfig& limits) {
  config_.shape.max_speed_m_s = limits.max_speed_m_s;
  config_.shape.max_turn_rad_s = limits.max_turn_rad_s;
  if (shape_) shape_->LimitSpeeds(config_.shape);
}

void PathFollower::Drop() {
  shape_.reset();
  arrived_ = false;
}

Twist2 PathFollower::Onward(const Pose2& pose) const {
  constexpr double kSlow = 0.1;  // [m/s]
  const PathShape::Point here = shape_->At(s_);
  const Eigen::Vector2d velocity = Pose2{0, 0, -pose.yaw} * Eigen::Vector2d(kSlow * here.direction);
  return {velocity.x(), velocity.y(), kSlow * here.turn};
}

PathFollower::Wanted PathFollower::Step(const Pose2& pose, const Twist2& twist, double age_s, double dt_s) {
  if (!shape_) return {};
  // Act on where the base will be when the wheels obey.
  const Pose2 ahead = ahead_ = Integrate(pose, twist, age_s + config_.latency_s);
  MoveReference(ahead, dt_s);
  Wanted wanted = Report(pose, shape_->At(s_));
  const PathShape::Point reference = ReferenceAt(s_);
  const double left = shape_->length() - s_;
  const Eigen::Vector2d error = reference.pose.translation() - ahead.translation();
  const double heading_error = WrapAngle(reference.pose.yaw - ahead.yaw);
  arrived_ = arrived_ || IsAtGoal(ahead);
  wanted.arrived = arrived_;
  if (arrived_) return wanted;

  // The last centimetres decay with the gain instead of following the braking parabola into its steep end.
  speed_ = PaceAt(left);
  if (detour_.leaves()) speed_ *= std::max(0.0, 1 - error.norm() / config_.aside_m);
  Eigen::Vector2d correction = error * config_.gain_per_s;
  const double fastest = detour_.leaves() ? config_.aside_speed_m_s : config_.correction_speed_m_s;
  if (correction.norm() > fastest) correction *= fastest / correction.norm();
  const Eigen::Vector2d velocity =
      Pose2{0, 0, -ahead.yaw} * Eigen::Vector2d(reference.direction * speed_ + correction);
  const double turn = std::clamp(heading_error * config_.turn_gain_per_s, -config_.correction_turn_rad_s,
                                 config_.correction_turn_rad_s);
  wanted.twist = {velocity.x(), velocity.y(), reference.turn * speed_ + turn};
  return wanted;
}

/// Beside its goal a base is at the end only of a way that was looked for there: from farther back it could
/// not see, or not reach, how it gets to the goal itself. Nor has one arrived beside a goal that is free.
bool PathFollower::IsAtGoal(const Pose2& pose) const {
  if (!detour_.leads_on()) return false;
  if (detour_.leaves() && detour_.from() < shape_->length() - kLookedAtEnd_m) return false;
  if (shape_->length() - s_ > PathShape::kTurnLever * Radians(config_.arrival_deg) + config_.arrival_m)
    return false;
  const Pose2 goal = ReferenceAt(shape_->length()).pose;
  return (goal.translation() - pose.translation()).norm() < config_.arrival_m &&
         std::abs(WrapAngle(goal.yaw - pose.yaw)) < Radians(config_.arrival_deg);
}

void PathFollower::MoveReference(const Pose2& pose, double dt_s) {
  const PathShape::Point at = shape_->At(s_);
  const double pace = std::hypot(at.direction.norm(), PathShape::kTurnLever * at.turn);
  // At the point of a sharp reversal the base hardly moves, so its pose does not show how far it has got.
  constexpr double kMeasurablePace = 0.4;
  s_ = pace < kMeasurablePace ? std::min(s_ + speed_ * dt_s, shape_->length()) : shape_->Project(pose, s_);
}

/// The point of the path, or of the detour beside it, where the base should be.
PathShape::Point PathFollower::ReferenceAt(double s) const {
  PathShape::Point point = shape_->At(s);
  if (!detour_.leaves()) return point;
  const Eigen::Vector2d left = point.left();
  const double slope = detour_.SlopeAt(s), longer = std::hypot(1, slope);
  const Eigen::Vector2d aside = left * detour_.At(s);
  point.pose.x += aside.x();
  point.pose.y += aside.y();
  point.direction = (point.direction + left * (slope * point.direction.norm())) / longer;
  point.turn /= longer;
  return point;
}

/// s_ is beside `ahead_`, too.
PathPlace PathFollower::Place() const {
  const PathShape::Point point = shape_->At(s_);
  return {s_, point.left().dot(ahead_.translation() - point.pose.translation())};
}

PathFollower::Wanted PathFollower::Report(const Pose2& pose, const PathShape::Point& reference) const {
  Wanted wanted;
  wanted.remaining_m = shape_->RemainingDistance(s_);
  const Eigen::Vector2d off = pose.translation() - reference.pose.translation();
  const double pace = reference.direction.norm();
  wanted.cross_track_m = pace > 0.1
                             ? (reference.direction.x() * off.y() - reference.direction.y() * off.x()) / pace
                             : off.norm();
  wanted.heading_error_rad = WrapAngle(reference.pose.yaw - pose.yaw);
  return wanted;
}

}  // namespace priamos::robot
