#include "robot/core/motion/yield.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

/// So far beside the middle somebody is surely on one side: beams are broad.
constexpr double kBeside_m = 0.15;
constexpr double kComes_m_s = 0.2;
/// Whoever comes so soon after is the same one.
constexpr std::chrono::seconds kSameOne{15};

}  // namespace

void YieldConfig::Describe(Archive& a) {
  a.Number("ahead_s", ahead_s, {"s", 0, 10, "so long before they would meet the base does not go ahead"});
  a.Number("ahead_m", ahead_m, {"m", 0, 5, "and so much farther away"});
  a.Number("near_m", near_m, {"m", 0, 5, "who is so near sees a base that stands"});
  a.Number("aside_m_s", aside_m_s, {"m/s", 0.01, 1, "fastest velocity to the side"});
  a.Number("gain_per_s", gain_per_s, {"1/s", 0.1, 10, "velocity to the side per distance"});
  a.Number("patience_s", patience_s, {"s", 0, 60, "time that who stands so near is waited for"});
  a.Number("wait_s", wait_s, {"s", 0, 30, "time without anybody coming until it goes on"});
}

std::optional<double> Yield::Step(const std::optional<Comer>& comer, double offset_m, double room_m,
                                  Time now) {
  const bool comes = comer && comer->speed_m_s > kComes_m_s &&
                     comer->free_m < comer->speed_m_s * config_.ahead_s + config_.ahead_m;
  // People keep to the right; the side is chosen once, so that nobody's way is crossed who stops and comes
  // on.
  const bool again = last_ && now - *last_ < kSameOne;
  if (comes && !again) side_ = comer->left_m < -kBeside_m ? 1 : -1;
  if (comes) since_ = last_ = now;
  if (!since_) return std::nullopt;
  const bool near = comer && comer->free_m < config_.near_m;
  if (now - *since_ >= FromSeconds(near ? config_.patience_s : config_.wait_s)) {
    since_.reset();
    return std::nullopt;
  }
  if (near) return 0;
  const double to_go_m = side_ * std::max(0.0, room_m) - offset_m;
  return std::clamp(config_.gain_per_s * to_go_m, -config_.aside_m_s, config_.aside_m_s);
}

}  // namespace priamos::robot
