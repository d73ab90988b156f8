#include "head/core/floor/laser_watch.hpp"

#include "common/image_size.hpp"

namespace priamos::head {
namespace {

constexpr double kLowerAgain_s = 5;
constexpr double kMargin = 0.15;  // of the picture's height

}  // namespace

void LaserWatchConfig::Describe(Archive& a) {
  a.Number("rate_hz", rate_hz, {"Hz", 0, 25, "pictures of the laser's line; 0: none"});
  a.Number("tilt_deg", tilt_deg, {"deg", -45, 45, "tilt of the head meanwhile, positive looks down"});
  a.Number("idle_s", idle_s,
           {"s", 0, 60, "time after a look, or an operator's order, until the head turns down"});
  a.Section("obstacle", obstacle, "what stands out from the floor");
}

LaserWatch::Action LaserWatch::Step(bool needed, bool sees, Time now) {
  if (config_.rate_hz <= 0) return Action::kWait;
  if (needed) {
    idle_since_.reset();
    lowered_.reset();
    picture_.Drop();  // a picture of a moving head is of no use
    return Action::kWait;
  }
  if (!idle_since_) idle_since_ = now;
  if (Seconds(now - *idle_since_) < config_.idle_s) return Action::kWait;
  if (!sees) {
    picture_.Drop();
    if (lowered_ && Seconds(now - *lowered_) < kLowerAgain_s) return Action::kWait;
    lowered_ = now;
    return Action::kLower;
  }
  if (triggered_ && Seconds(now - *triggered_) < 1 / config_.rate_hz) return Action::kWait;
  triggered_ = now;
  picture_.Order();
  return Action::kTrigger;
}

bool SeesLine(const CameraModel& camera, const LaserPlane& laser, int width, int height) {
  const Eigen::Vector3d at(-laser.offset_m / laser.normal.x(), 0, 0);
  if (!at.allFinite() || at.x() < 0.2 || camera.Depth(at) < 0.1) return false;
  const Eigen::Vector2d px = camera.Project(at);
  return px.x() > 0 && px.x() < width - 1 && px.y() > kMargin * height && px.y() < (1 - kMargin) * height;
}

bool SeesLine(const HeadModel& head, const HeadSetting& setting) {
  constexpr ImageSize kPicture{};
  if (!head.laser) return false;
  const auto camera = head.CameraAt(setting, kThird);
  return camera && SeesLine(*camera, *head.laser, kPicture.width, kPicture.height);
}

}  // namespace priamos::head
