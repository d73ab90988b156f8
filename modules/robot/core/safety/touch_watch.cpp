#include "robot/core/safety/touch_watch.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

namespace priamos::robot {
namespace {

/// Beside the footprint, so that a motion away from the place is none towards it.
constexpr double kBeside_m = 0.005;
/// A force that has fallen below this part of the limit has ended; the next one is a new touch.
constexpr double kEnded = 0.5;
constexpr std::size_t kMostPlaces = 200;

constexpr std::uint8_t kFront = 0x81, kLeft = 0x06, kRear = 0x18, kRight = 0x60;
constexpr std::array<std::string_view, 8> kSegments{
    "the front's left half",       "the left side's front half", "the left side's rear half",
    "the rear's left half",        "the rear's right half",      "the right side's rear half",
    "the right side's front half", "the front's right half"};

/// The side that is pushed; 0 for a turn, which may push anywhere.
std::uint8_t SideOf(const Eigen::Vector3d& push) {
  if (std::abs(push.z()) > std::abs(push.x()) + std::abs(push.y())) return 0;
  if (std::abs(push.x()) >= std::abs(push.y())) return push.x() > 0 ? kFront : kRear;
  return push.y() > 0 ? kLeft : kRight;
}

/// Ends of a segment, base frame, counter-clockwise from the left half of the front.
std::array<Eigen::Vector2d, 2> EndsOf(int segment, const Footprint& footprint) {
  const double x = footprint.length_m / 2 + kBeside_m, y = footprint.width_m / 2 + kBeside_m;
  const std::array<Eigen::Vector2d, 8> corners{
      {{x, 0}, {x, y}, {0, y}, {-x, y}, {-x, 0}, {-x, -y}, {0, -y}, {x, -y}}};
  return {corners[segment], corners[(segment + 1) % 8]};
}

/// Whether a base that moves so comes nearer to what lies at one of the segments.
bool MovesTowards(std::uint8_t segments, const Twist2& motion, const Footprint& footprint) {
  constexpr double kStands_m_s = 0.015;
  const double turning = std::abs(motion.wz) * footprint.Reach();
  const std::array<double, 4> outwards{motion.vx, motion.vy, -motion.vx,
                                       -motion.vy};  // front, left, rear, right
  for (std::size_t i = 0; i < 8; ++i) {
    if ((segments >> i & 1) == 0) continue;
    if (outwards[((i + 1) / 2) % 4] + turning > kStands_m_s) return true;
  }
  return false;
}

}  // namespace

void TouchConfig::Describe(Archive& a) {
  a.Flag("bumper", bumper, "the base has a bumper: when it is silent, the base holds");
  a.Number("push_n", push_n, {"N", 10, 5000, "a larger force than acceleration and rolling take is a touch"});
  a.Number("keep_s", keep_s, {"s", 1, 3600, "the place of a touch counts as an obstacle for so long"});
  a.Number("told_s", told_s,
           {"s", 0, 10, "so long nothing moves after a touch, so that it is told before it is covered up"});
  a.Section("push", push, "motors and mass, for the force by motor currents");
}

TouchWatch::TouchWatch(const TouchConfig& config, const Footprint& footprint, const MecanumGeometry& geometry)
    : config_(config), footprint_(footprint), push_(config.push, geometry) {}

void TouchWatch::AddBumper(std::uint8_t pressed, Time time) {
  noticed_ &= pressed;
  pressed_ = pressed;
  bumper_heard_ = time;
}

std::optional<Touch> TouchWatch::Update(const Pose2& odom_from_base, Time now,
                                        const std::optional<Twist2>& motion) {
  while (!places_.empty() &&
         (now - places_.front().time > FromSeconds(config_.keep_s) || places_.size() > kMostPlaces))
    places_.pop_front();
  auto touch = TouchOfBumper(now);
  const auto push = TouchOfPush(now);
  if (!touch) touch = push;
  if (touch)
    touch->came = motion && touch->push_n == 0 && !MovesTowards(touch->segments, *motion, footprint_);
  if (touch && !touch->came) Remember(touch->segments, odom_from_base, now);
  return touch;
}

std::optional<Touch> TouchWatch::TouchOfBumper(Time now) {
  const auto fresh = static_cast<std::uint8_t>(pressed_ & ~noticed_);
  noticed_ = pressed_;
  if (fresh == 0) return std::nullopt;
  return Touch{now, fresh, 0};
}

std::optional<Touch> TouchWatch::TouchOfPush(Time now) {
  const auto push = push_.Push();
  const double force_n = push ? push->norm() : 0;
  const bool pushed = pushes_;
  pushes_ = force_n > config_.push_n * (pushed ? kEnded : 1);
  if (!pushes_ || pushed) return std::nullopt;
  return Touch{now, SideOf(*push), force_n};
}

void TouchWatch::Remember(std::uint8_t segments, const Pose2& odom_from_base, Time now) {
  for (int i = 0; i < 8; ++i) {
    if ((segments >> i & 1) == 0) continue;
    const auto [from, to] = EndsOf(i, footprint_);
    for (const double part : {0.0, 0.5, 1.0})
      places_.push_back({odom_from_base * Eigen::Vector2d(from + part * (to - from)), now});
  }
}

std::vector<Eigen::Vector2d> TouchWatch::Points(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> points;
  points.reserve(places_.size());
  for (const Place& place : places_) points.push_back(base_from_odom * place.odom);
  return points;
}

std::string SegmentsText(std::uint8_t segments) {
  std::string text;
  for (std::size_t i = 0; i < kSegments.size(); ++i)
    if (segments >> i & 1) text += fmt::format("{}{}", text.empty() ? "" : ", ", kSegments[i]);
  return text.empty() ? "no known side" : text;
}

}  // namespace priamos::robot
