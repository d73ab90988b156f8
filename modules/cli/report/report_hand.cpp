#include "cli/report/report_hand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/scenario/free_motion.hpp"
#include "common/time.hpp"
#include "robot/robot_config.hpp"

namespace priamos::cli {
namespace {

constexpr std::int64_t kStep_us = 100'000;
constexpr double kStanding_m_s = 0.02, kStanding_rad_s = 0.03;
/// Time from a motion of the hand to one of the base: radio, tick of the robot, drive board.
constexpr std::int64_t kReaction_us = 100'000;
constexpr double kBesidePassage_m = 0.3;

Twist2 TwistOf(const world_truth_t& truth) {
  return {truth.vx_m_s, truth.vy_m_s, truth.wz_rad_s};
}

bool Stands(const world_truth_t& truth) {
  return std::hypot(truth.vx_m_s, truth.vy_m_s) < kStanding_m_s && std::abs(truth.wz_rad_s) < kStanding_rad_s;
}

/// The velocities that an operator wished, base frame. Times are asked in order.
class Wishes {
 public:
  explicit Wishes(const std::vector<drive_command_t>& commands) : commands_(commands) {}

  /// The wish that counts at `utime`; nullopt when there is none, or it is to stand.
  std::optional<Twist2> At(std::int64_t utime) {
    while (next_ < commands_.size() && commands_[next_].utime <= utime) ++next_;
    if (next_ == 0) return std::nullopt;
    const drive_command_t& newest = commands_[next_ - 1];
    const bool rests = newest.vx_m_s == 0 && newest.vy_m_s == 0 && newest.wz_rad_s == 0;
    if (rests || Seconds(Duration(utime - newest.utime)) > newest.time_to_live_s) return std::nullopt;
    return Twist2{newest.vx_m_s, newest.vy_m_s, newest.wz_rad_s};
  }

 private:
  const std::vector<drive_command_t>& commands_;
  std::size_t next_ = 0;
};

bool IsInPassage(const Pose2& map_from_base, const world::Body& body, const DoorPlan& passage) {
  const Pose2 base = passage.map_from_door().Inverse() * map_from_base;
  const double reach = body.size_m.x() / 2 + kBesidePassage_m;
  return base.x > passage.FrontX() - reach && base.x < passage.BackX() + reach &&
         std::abs(base.y) < passage.opening_width_m / 2;
}

std::optional<double> LongestStop(const RunRecord& record, const world::Body& body, const DoorPlan& passage) {
  Wishes wishes(record.commands);
  std::optional<double> longest;
  std::int64_t moved_utime = 0;
  for (const world_truth_t& truth : record.truth) {
    const bool pushed = wishes.At(truth.utime).has_value();
    const bool inside = IsInPassage(PoseOf(truth), body, passage);
    if (inside && !longest) longest = 0;
    if (!inside || !pushed || !Stands(truth)) {
      moved_utime = truth.utime;
    } else {
      longest = std::max(longest.value_or(0), Seconds(Duration(truth.utime - moved_utime)));
    }
  }
  return longest;
}

/// Adds up what was free and what was done of it, step by step.
class HonourSum {
 public:
  HonourSum(const TrueWorld& world, HandSummary& sum)
      : free_motion_(world), within_reach_(robot::DriveConfig().operator_acceleration), sum_(sum) {}

  void Rest() { pushed_ = false; }
  void Push(const world_truth_t& truth, const Twist2& wish, double seconds) {
    if (!pushed_) within_reach_.SetCommanded(TwistOf(truth));
    pushed_ = true;
    const Twist2 free = within_reach_.Step(free_motion_.Of(PoseOf(truth), wish), seconds);
    const double free_m_s = std::max(0.0, free_motion_.Along(wish, free));
    const double made_m_s = std::clamp(free_motion_.Along(wish, TwistOf(truth)), 0.0, free_m_s);
    sum_.wished_s += seconds;
    sum_.free_m += free_m_s * seconds;
    sum_.achieved_m += made_m_s * seconds;
  }

 private:
  FreeMotion free_motion_;
  robot::TwistSlew within_reach_;
  HandSummary& sum_;
  bool pushed_ = false;
};

}  // namespace

std::optional<double> HandSummary::honoured() const {
  constexpr double kLeast_m = 0.01;
  return free_m > kLeast_m ? std::optional(achieved_m / free_m) : std::nullopt;
}

std::optional<HandSummary> HandSummaryOf(const RunRecord& record, const TrueWorld& world,
                                         const std::optional<DoorPlan>& passage) {
  HandSummary summary;
  HonourSum sum(world, summary);
  Wishes wishes(record.commands);
  const world_truth_t* last = nullptr;
  for (const world_truth_t& truth : record.truth) {
    if (last && truth.utime - last->utime < kStep_us) continue;
    const double seconds = last ? Seconds(Duration(truth.utime - last->utime)) : Seconds(Duration(kStep_us));
    last = &truth;
    if (const auto wish = wishes.At(truth.utime - kReaction_us)) {
      sum.Push(truth, *wish, seconds);
    } else {
      sum.Rest();
    }
  }
  if (summary.wished_s == 0) return std::nullopt;
  if (passage) summary.longest_stop_s = LongestStop(record, world.body, *passage);
  return summary;
}

std::string FaultOf(const HandSummary& hand, double longest_stop_s) {
  if (longest_stop_s == 0 || hand.longest_stop_s.value_or(0) <= longest_stop_s) return "";
  return fmt::format("stood in the passage for {:.1f} s while the operator pushed, {:.1f} s are allowed",
                     *hand.longest_stop_s, longest_stop_s);
}

}  // namespace priamos::cli
