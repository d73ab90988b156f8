#include "cli/scenario/teleop_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace priamos::cli {
namespace {

constexpr std::uint32_t kDeadMan = 1u << 0, kRange = 1u << 4;
/// The hand goes to the dead-man first, and pushes when the lease is there.
constexpr Duration kGripAgain = std::chrono::seconds(3);
constexpr Duration kKeyPress = std::chrono::milliseconds(200);
constexpr int kFullScale = 350;

/// Full deflection farther away than this, proportionally less nearer.
constexpr double kFullFrom_m = 0.5, kFullFrom_rad = 0.6;
constexpr double kNear_m = 0.12;
constexpr double kLeastDeflection = 0.25;

double Deflection(double error, double full_from) {
  const double part = std::clamp(error / full_from, -1.0, 1.0);
  return std::abs(part) < 0.02 ? 0 : std::copysign(std::max(kLeastDeflection, std::abs(part)), part);
}

}  // namespace

TeleopStory::TeleopStory(const StoryStage& stage)
    : scenario_(stage.scenario),
      progress_(stage.progress),
      line_(stage.open_mouse()),
      mouse_(kFullScale),
      rng_(Rng::Stream(stage.seed, "operator")),
      truth_(stage.onboard.Subscribe(channels::kWorldTruth)),
      alive_(stage.scenario, stage.onboard, stage.offboard),
      status_(stage.offboard.Subscribe(channels::kDriveStatus)) {}

void TeleopStory::Tick(Time now) {
  if (!start_) start_ = now;
  alive_.Listen();
  if (!began_ && Ready()) {
    began_ = now;
    progress_(now, "all processes are alive; the operator takes the space-mouse");
  }
  if (began_ && !ended_) Decide(now);
  MoveMouse(now);
}

bool TeleopStory::Ready() const {
  return alive_.Missing().empty() && mouse_.awake() && truth_.get() && status_.get();
}

void TeleopStory::Decide(Time now) {
  if (truth_.get()->contacts > 0) return Finish(now, false, "the base touched something");
  if (!gripped_ || (status_.get()->driver != lease_request_t::TELEOP && now - *gripped_ > kGripAgain)) {
    // Let go once, so that the grip is a new one.
    const bool held = (hand_.buttons & kDeadMan) != 0;
    hand_ = {};
    if (!held) {
      hand_.buttons = kDeadMan;
      gripped_ = now;
    }
    return;
  }
  if (status_.get()->driver != lease_request_t::TELEOP) return;
  if (scenario_.waypoints.empty()) return Shake(now);
  DriveToWaypoint(now);
}

void TeleopStory::DriveToWaypoint(Time now) {
  const world_truth_t& truth = *truth_.get();
  const ScenarioWaypoint& goal = scenario_.waypoints[waypoint_];
  const Pose2 map_from_base{truth.x_m, truth.y_m, truth.yaw_rad};
  const Eigen::Vector2d delta = map_from_base.Inverse() * Eigen::Vector2d(goal.x_m, goal.y_m);
  if (delta.norm() < kNear_m) {
    progress_(now, fmt::format("at waypoint {} of {}: ({:.2f}, {:.2f}) m", waypoint_ + 1,
                               scenario_.waypoints.size(), truth.x_m, truth.y_m));
    if (++waypoint_ == scenario_.waypoints.size())
      return Finish(now, true, "the operator is where he wanted to be");
  }
  const double size = std::max(delta.norm(), 1e-6);
  const double push = Deflection(size, kFullFrom_m);
  hand_.axis = {};
  hand_.axis[0] = push * delta.x() / size;
  hand_.axis[1] = push * delta.y() / size;
  hand_.axis[5] = Deflection(WrapAngle(Radians(goal.yaw_deg) - truth.yaw_rad), kFullFrom_rad);
  Waver(now);
  // A hand presses the range key once, for the whole drive.
  if (!driving_) driving_ = now;
  const bool toggle = scenario_.fast && now - *driving_ < kKeyPress;
  hand_.buttons = kDeadMan | (toggle ? kRange : 0);
}

/// A hand that is not exact pushes in a wrong direction for a while, and rests now and then.
void TeleopStory::Waver(Time now) {
  if (scenario_.astray_deg == 0) return;
  if (!waver_until_ || now >= *waver_until_) {
    waver_until_ = now + FromSeconds(rng_.Uniform(0.3, 2.0));
    astray_rad_ = rng_.Normal(Radians(scenario_.astray_deg));
    rests_ = rng_.Chance(0.15);
  }
  const Eigen::Vector2d push = Pose2{0, 0, astray_rad_} * Eigen::Vector2d(hand_.axis[0], hand_.axis[1]);
  hand_.axis[0] = rests_ ? 0 : push.x();
  hand_.axis[1] = rests_ ? 0 : push.y();
  if (rests_) hand_.axis[5] = 0;
}

/// Holds a random deflection for a random while; lets go of everything now and then.
void TeleopStory::Shake(Time now) {
  if (Seconds(now - *began_) > scenario_.shake_s) return Finish(now, true, "the operator has shaken enough");
  if (shake_until_ && now < *shake_until_) return;
  shake_until_ = now + FromSeconds(rng_.Uniform(0.1, 3.0));
  hand_.axis = {};
  hand_.buttons = kDeadMan | (rng_.Chance(0.1) ? kRange : 0);
  if (rng_.Chance(0.1)) return;
  for (const std::size_t axis : {0u, 1u, 5u}) hand_.axis[axis] = rng_.Uniform(-1, 1);
}

void TeleopStory::Finish(Time now, bool succeeded, const std::string& text) {
  ended_ = now;
  succeeded_ = succeeded;
  text_ = text;
  hand_ = {};
  progress_(now, text);
}

void TeleopStory::MoveMouse(Time now) {
  std::array<std::byte, 64> heard;
  std::string bytes;
  while (const std::size_t n = line_->Read(heard))
    bytes.append(reinterpret_cast<const char*>(heard.data()), n);
  const std::string packets = mouse_.Hear(bytes) + mouse_.Move(hand_, now);
  line_->Write(std::as_bytes(std::span(packets)));
}

bool TeleopStory::Done(Time now) const {
  if (ended_) return now - *ended_ >= kAftermath;
  return start_ && Seconds(now - *start_) >= scenario_.time_limit_s;
}

std::string TeleopStory::Reason() const {
  if (ended_) return text_;
  if (!began_) return "not all processes came to life";
  return fmt::format("time limit of {:.0f} s reached on the way to waypoint {}", scenario_.time_limit_s,
                     waypoint_ + 1);
}

template StoryKind KindOf<TeleopStory>();

}  // namespace priamos::cli
