#include "head/core/floor/laser_watch.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr double kLowerAgain_s = 5;
constexpr double kMargin = 0.1;      // of the picture's height
constexpr double kHalfLine_m = 1.1;  // what the light reaches to either side at least
constexpr double kLeastSeen_m = 0.6, kStep_m = 0.1;
constexpr double kHalfExposure_s = 0.01;  // at most
constexpr double kRests_rad = 1e-3;       // reports of a head at rest differ by less

bool IsSame(const HeadSetting& a, const HeadSetting& b) {
  return std::abs(a.pan_rad - b.pan_rad) < kRests_rad && std::abs(a.tilt_rad - b.tilt_rad) < kRests_rad;
}

}  // namespace

void LaserWatchConfig::Describe(Archive& a) {
  a.Number("rate_hz", rate_hz, {"Hz", 0, 25, "pictures of the lasers' lines; 0: none"});
  a.Number("tilt_deg", tilt_deg,
           {"deg", -45, 45,
            "tilt of a head that nobody needs, from where it sees the lines; positive looks down"});
  a.Number("idle_s", idle_s,
           {"s", 0, 60, "time after a look, or an operator's order, until the head turns down"});
  a.Section("obstacle", obstacle, "what stands out from the floor");
}

LaserWatch::Action LaserWatch::Step(const WatchMoment& moment, const HeadSetting& here, Time now) {
  if (config_.rate_hz <= 0) return Action::kWait;
  if (moment.needed) {
    idle_since_.reset();
    lowered_.reset();
  } else if (!idle_since_) {
    idle_since_ = now;
  }
  if (MayLower(now) && !moment.sees_all) {
    lowered_ = now;
    return Action::kLower;
  }
  const bool due = !triggered_ || Seconds(now - *triggered_) >= 1 / config_.rate_hz;
  if (!moment.sees || moment.exposing || !due) return Action::kWait;
  triggered_ = rested_until_ = now;
  at_ = here;
  rests_ = true;
  picture_.Order();
  return Action::kTrigger;
}

bool LaserWatch::MayLower(Time now) const {
  return idle_since_ && Seconds(now - *idle_since_) >= config_.idle_s &&
         (!lowered_ || Seconds(now - *lowered_) >= kLowerAgain_s);
}

void LaserWatch::Report(const HeadSetting& setting, bool moving, Time time) {
  rests_ = rests_ && !moving && IsSame(setting, at_);
  if (rests_) rested_until_ = std::max(rested_until_, time);
}

std::optional<HeadSetting> LaserWatch::Takes(const FrameNotice& frame) {
  if (!picture_.Takes(frame)) return std::nullopt;
  if (Seconds(rested_until_ - frame.exposure) < kHalfExposure_s && !rests_) return std::nullopt;
  return at_;
}

bool SeesLine(const CameraModel& camera, const LaserPlane& laser, const ImageSize& picture) {
  const double margin = kMargin * picture.height;
  double seen_m = 0;
  for (double y = -kHalfLine_m; y <= kHalfLine_m; y += kStep_m) {
    const Eigen::Vector3d at(-(laser.offset_m + laser.normal.y() * y) / laser.normal.x(), y, 0);
    if (!at.allFinite() || at.x() < 0.2 || camera.Depth(at) < 0.1) continue;
    const Eigen::Vector2d px = camera.Project(at);
    if (px.x() > 0 && px.x() < picture.width - 1 && px.y() > margin && px.y() < picture.height - margin)
      seen_m += kStep_m;
  }
  return seen_m >= kLeastSeen_m;
}

std::size_t LinesSeen(const HeadModel& head, const HeadSetting& setting) {
  const auto camera = head.CameraAt(setting, kThird);
  if (!camera) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(
      head.lasers, [&](const LaserPlane& laser) { return SeesLine(*camera, laser, ImageSize{}); }));
}

}  // namespace priamos::head
