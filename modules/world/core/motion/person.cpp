#include "world/core/motion/person.hpp"

#include <algorithm>
#include <cmath>

#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

constexpr double kDecide_s = 0.1, kLook_s = 1, kLeastLook_m = 0.4;
constexpr double kOfRobot_m = 0.6, kOfWalls_m = 0.2;
constexpr std::array kTurns_deg{0, 25, -25, 50, -50, 75, -75};
constexpr double kArrived_m = 0.15;
constexpr double kGivesUp_s = 4, kTurnsBack_s = 2;
constexpr double kDoubleStep_m = 1.4, kLegSwing_m = 0.15;
/// Walking speed with which the last half step is made.
constexpr double kClosing_m_s = 0.8;
/// A robot farther away than this from the middle of a body cannot be touched by it.
constexpr double kReach_m = 0.7;

struct BodyPart {
  const char* name;
  double length_m, width_m, low_m, high_m;
  double ahead_m, beside_m;  ///< of the middle of the body
  double swing_m;            ///< before and behind that while walking
};
constexpr std::array<BodyPart, kBodyParts> kParts{
    {{"left leg", 0.13, 0.13, 0.08, 0.80, 0, 0.11, kLegSwing_m},
     {"right leg", 0.13, 0.13, 0.08, 0.80, 0, -0.11, -kLegSwing_m},
     {"trunk", 0.24, 0.46, 0.80, 1.45, 0, 0, 0},
     {"head", 0.20, 0.16, 1.45, 1.72, 0, 0, 0},
     {"left foot", 0.26, 0.10, 0, 0.08, 0.04, 0.11, 2 * kLegSwing_m},
     {"right foot", 0.26, 0.10, 0, 0.08, 0.04, -0.11, -2 * kLegSwing_m}}};

Pose2 PoseOf(const BodyPart& part, const Posture& posture) {
  return posture.map_from_person *
         Pose2{part.ahead_m + part.swing_m * std::sin(posture.phase_rad), part.beside_m, 0};
}

Posture Between(const Posture& a, const Posture& b, double part) {
  const auto mix = [part](double from, double to) { return from + part * (to - from); };
  const Pose2 &p = a.map_from_person, &q = b.map_from_person;
  return {{mix(p.x, q.x), mix(p.y, q.y), WrapAngle(p.yaw + part * WrapAngle(q.yaw - p.yaw))},
          mix(a.phase_rad, b.phase_rad)};
}

double Nearest(const std::vector<Rectangle>& walls, const Eigen::Vector2d& at) {
  double nearest = 10;
  for (const Rectangle& wall : walls) nearest = std::min(nearest, Distance(wall, at));
  return nearest;
}

}  // namespace

std::array<Solid, kBodyParts> SolidsOf(const std::string& name, const Posture& posture) {
  std::array<Solid, kBodyParts> solids;
  for (std::size_t i = 0; i < kBodyParts; ++i) {
    const BodyPart& part = kParts[i];
    solids[i] = {name + ": " + part.name,
                 PoseOf(part, posture),
                 {part.length_m, part.width_m},
                 part.low_m,
                 part.high_m,
                 "fabric"};
  }
  return solids;
}

std::array<Pose2, kBodyParts> PartPoses(const Posture& posture) {
  std::array<Pose2, kBodyParts> poses;
  for (std::size_t i = 0; i < kBodyParts; ++i) poses[i] = PoseOf(kParts[i], posture);
  return poses;
}

Person::Person(PersonPlan plan, Rng rng) : plan_(std::move(plan)), rng_(rng), pause_s_(plan_.start_s) {
  const PersonStop& first = plan_.waypoints.at(0);
  posture_.map_from_person = {first.x_m, first.y_m, 0};
  next_ = 1 % plan_.waypoints.size();
  const Eigen::Vector2d ahead = Target() - posture_.map_from_person.translation();
  posture_.map_from_person.yaw = std::atan2(ahead.y(), ahead.x());
}

Eigen::Vector2d Person::Target() const {
  return {plan_.waypoints[next_].x_m, plan_.waypoints[next_].y_m};
}

void Person::Step(double dt_s, const Around& around) {
  if (plan_.waypoints.size() < 2) return;
  if (pause_s_ > 0) {
    pause_s_ -= dt_s;
    return CloseStep(dt_s);
  }
  decide_in_s_ -= dt_s;
  if (decide_in_s_ <= 0) {
    decide_in_s_ += kDecide_s;
    Decide(around);
  }
  walking_ ? Advance(dt_s, around) : CloseStep(dt_s);
}

/// Who stands brings the legs together; the feet draw in, so that they meet nothing.
void Person::CloseStep(double dt_s) {
  const double together_rad = kPi * std::round(posture_.phase_rad / kPi);
  const double most_rad = 2 * kPi * kClosing_m_s / kDoubleStep_m * dt_s;
  posture_.phase_rad += std::clamp(together_rad - posture_.phase_rad, -most_rad, most_rad);
}

void Person::Decide(const Around& around) {
  const Eigen::Vector2d ahead = Target() - posture_.map_from_person.translation();
  if (ahead.norm() < kArrived_m) {
    const PersonStop& here = plan_.waypoints[next_];
    pause_s_ = std::max(0.0, here.pause_s + rng_.Uniform(-1, 1) * here.pause_spread_s);
    walking_ = false;
    return GoOn();
  }
  const double straight = std::atan2(ahead.y(), ahead.x());
  const auto turn = std::find_if(kTurns_deg.begin(), kTurns_deg.end(),
                                 [&](double deg) { return FreeAhead(straight + Radians(deg), around); });
  walking_ = turn != kTurns_deg.end();
  if (walking_) posture_.map_from_person.yaw = WrapAngle(straight + Radians(*turn));
  stood_s_ = walking_ ? 0 : stood_s_ + kDecide_s;
  if (stood_s_ >= kGivesUp_s) GoOn();
}

/// The next waypoint; round and round, or back after a collision.
void Person::GoOn() {
  const std::size_t n = plan_.waypoints.size();
  next_ = (next_ + (forward_ ? 1 : n - 1)) % n;
  stood_s_ = held_s_ = 0;
}

/// Whoever stands too near already may go where it does not get nearer.
bool Person::FreeAhead(double heading_rad, const Around& around) const {
  const Eigen::Vector2d here = posture_.map_from_person.translation();
  const Eigen::Vector2d along(std::cos(heading_rad), std::sin(heading_rad));
  const double look_m = std::min(std::max(kLook_s * plan_.speed_m_s, kLeastLook_m), (Target() - here).norm());
  const double of_robot = std::min(kOfRobot_m, Distance(around.robot, here));
  const double of_walls = std::min(kOfWalls_m, Nearest(around.walls, here));
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const Eigen::Vector2d there = here + part * look_m * along;
    if (plan_.attentive && Distance(around.robot, there) < of_robot) return false;
    if (Nearest(around.walls, there) < of_walls) return false;
  }
  return true;
}

bool Person::AgainstRobot(const Posture& posture, const Around& around) const {
  if (Distance(around.robot, posture.map_from_person.translation()) > kReach_m) return false;
  for (const BodyPart& part : kParts) {
    const Rectangle outline{PoseOf(part, posture), {part.length_m / 2, part.width_m / 2}};
    if (Distance(outline, around.robot) <= 0) return true;
  }
  return false;
}

void Person::Advance(double dt_s, const Around& around) {
  const double step_m = plan_.speed_m_s * dt_s;
  const Pose2& from = posture_.map_from_person;
  Posture wanted = posture_;
  wanted.map_from_person = from * Pose2{step_m, 0, 0};
  wanted.phase_rad += 2 * kPi * step_m / kDoubleStep_m;
  const auto apart_m = [&](const Pose2& pose) { return Distance(around.robot, pose.translation()); };
  // Whoever turned against the robot may leave it.
  if (!AgainstRobot(wanted, around) || apart_m(wanted.map_from_person) > apart_m(from)) {
    posture_ = wanted;
    held_s_ = 0;
    return;
  }
  double free = 0, blocked = 1;
  for (int i = 0; i < 7; ++i) {
    const double middle = (free + blocked) / 2;
    (AgainstRobot(Between(posture_, wanted, middle), around) ? blocked : free) = middle;
  }
  posture_ = Between(posture_, wanted, free);
  held_s_ += dt_s;
  if (held_s_ < kTurnsBack_s) return;
  forward_ = !forward_;
  GoOn();
}

}  // namespace priamos::world
