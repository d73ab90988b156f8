#include "head/core/motion/head_jog.hpp"

#include <algorithm>
#include <cmath>

#include "common/robot/robot_drawing.hpp"
#include "common/robot/sequence_number.hpp"

namespace priamos::head {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(50);
constexpr Duration kLongestLife = std::chrono::milliseconds(500);
constexpr Duration kLongestPause = std::chrono::milliseconds(500);

bool IsCredible(const HeadWish& w) {
  const double sum = w.pan_rad_s + w.tilt_rad_s + w.vergence_rad_s + w.zoom_step_s + w.focus_step_s;
  return std::isfinite(sum) && w.time_to_live > Duration::zero() && w.time_to_live <= kLongestLife;
}

bool Moves(const HeadWish& w) {
  // A zero that was packed for the radio comes back with a rounding error.
  constexpr double kZero = 1e-6;
  return std::max({std::abs(w.pan_rad_s), std::abs(w.tilt_rad_s), std::abs(w.vergence_rad_s),
                   std::abs(w.zoom_step_s), std::abs(w.focus_step_s)}) > kZero;
}

int Added(int step, double change) {
  return static_cast<int>(std::clamp(step + std::round(change), 0.0, double(kDrawnHead.most_step)));
}

}  // namespace

bool HeadJog::Take(const HeadWish& wish, Time now) {
  const bool in_order =
      !newest_ || newest_->session != wish.session || IsAfter(wish.sequence, newest_->sequence);
  if (!IsCredible(wish) || !in_order || now > wish.time + wish.time_to_live) {
    ++refused_;
    return false;
  }
  wish_ = newest_ = wish;
  return true;
}

std::optional<HeadSetting> HeadJog::Step(const HeadSetting& here, Time now) {
  if (!wish_ || now > wish_->time + wish_->time_to_live || !Moves(*wish_)) {
    Stop();
    return std::nullopt;
  }
  if (!target_) {
    target_ = here;
    stepped_ = now - kPeriod;
  }
  if (now - stepped_ < kPeriod) return std::nullopt;
  const double dt = Seconds(kPeriod);
  stepped_ = now;
  moved_ = now;
  HeadSetting& t = *target_;
  t.pan_rad =
      std::clamp(t.pan_rad + wish_->pan_rad_s * dt, -kDrawnHead.most_pan_rad, kDrawnHead.most_pan_rad);
  t.tilt_rad =
      std::clamp(t.tilt_rad + wish_->tilt_rad_s * dt, -kDrawnHead.most_tilt_rad, kDrawnHead.most_tilt_rad);
  for (std::size_t i = 0; i < 2; ++i) {
    // Towards each other: the left camera turns right, the right one left.
    const double inward = i == 0 ? -1 : 1;
    t.vergence_rad[i] = std::clamp(t.vergence_rad[i] + inward * wish_->vergence_rad_s * dt,
                                   -kDrawnHead.most_vergence_rad, kDrawnHead.most_vergence_rad);
    t.zoom_step[i] = Added(t.zoom_step[i], wish_->zoom_step_s * dt);
    t.focus_step[i] = Added(t.focus_step[i], wish_->focus_step_s * dt);
  }
  return t;
}

bool HeadJog::IsHeld(Time now) const {
  return moved_ && now - *moved_ < kLongestPause;
}

}  // namespace priamos::head
