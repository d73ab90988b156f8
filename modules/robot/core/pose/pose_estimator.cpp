#include "robot/core/pose/pose_estimator.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/principal_axes.hpp"
#include "robot/core/pose/wheels_between.hpp"

namespace priamos::robot {
namespace {

/// A wall that was not heard for so long may be another one by now.
constexpr Duration kUnheard = std::chrono::seconds(2);

/// The part of `step` between two times.
OdometryStep Part(const OdometryStep& step, Time from, Time to) {
  OdometryStep part = step;
  part.from = from;
  part.to = to;
  const double share = Seconds(to - from) / step.seconds();
  part.noise *= share;
  part.wander = step.wander.Part(share);
  return part;
}

Pose2 ChangeOf(const Pose2& before, const Pose2& after) {
  return {after.x - before.x, after.y - before.y, WrapAngle(after.yaw - before.yaw)};
}

bool IsFinite(const Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

}  // namespace

void InitialPose::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -100, 100, "map: where the base stands when it starts"});
  a.Number("y_m", y_m, {"m", -100, 100, "map: where the base stands when it starts"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map: its heading"});
  a.Number("position_error_m", position_error_m, {"m", 0.001, 5, "bound of the error of x and of y"});
  a.Number("yaw_error_deg", yaw_error_deg, {"deg", 0.01, 90, "bound of the error of the heading"});
}

void PoseEstimatorConfig::Describe(Archive& a) {
  a.Number("history_s", history_s, {"s", 0.5, 60, "oldest picture that can still correct the pose"});
  a.Number("gate_distance", gate_distance,
           {"-", 1, 20, "Mahalanobis distance beyond which a fix is refused"});
  a.Number("least_fix_sigma_m", least_fix_sigma_m, {"m", 1e-5, 0.5, "no fix is believed to be better"});
  a.Number("least_fix_sigma_deg", least_fix_sigma_deg, {"deg", 1e-4, 10, "no fix is believed to be better"});
  a.Section("initial", initial, "where the robot starts; errors are bounds, not sigmas");
  a.Section("walls", walls, "which ranges of the sonars count as those of a straight wall");
  a.Section("plan", plan, "which straight walls count as those of the plan");
  a.Section("bias", bias, "constant errors of the odometry, sigma before the first fix");
}

double PoseEstimate::PositionSigma() const {
  return priamos::PositionSigma(covariance);
}

double PoseEstimate::YawSigma() const {
  return std::sqrt(std::max(0.0, covariance(2, 2)));
}

PoseEstimator::PoseEstimator(const PoseEstimatorConfig& config) : config_(config) {
  const InitialPose& initial = config.initial;
  initial_.mean.head<3>() << initial.x_m, initial.y_m, WrapAngle(Radians(initial.yaw_deg));
  const OdometryBias& b = config.bias;
  PoseState::Vector sigma = PoseState::Vector::Zero(PoseState::kOwn);
  sigma.head<PoseState::kWander>() << initial.position_error_m / std::sqrt(3),
      initial.position_error_m / std::sqrt(3), Radians(initial.yaw_error_deg) / std::sqrt(3), b.forward,
      b.sideways, b.yaw, b.yaw_rad_per_m, b.drift_m_per_m;
  initial_.covariance = sigma.cwiseAbs2().asDiagonal();
}

void PoseEstimator::Move(const OdometryStep& step) {
  const bool continues = !history_.empty() && step.from >= history_.back().step.to;
  if (!continues) {
    const PoseState state = history_.empty() ? initial_ : history_.back().state;
    history_.clear();
    history_.push_back({.step = {.from = step.from, .to = step.from}, .state = state});
    learnt_.reset();
  }
  history_.push_back({.step = step,
                      .state = Propagated(history_.back().state, step.Slipping(slip_factor_)),
                      .slip = slip_factor_});
  Forget();
}

Pose2 PoseEstimator::Reset(const KnownPose& known) {
  PoseState state = history_.empty() ? initial_ : history_.back().state;
  while (state.walls() > 0) state = WithoutWall(state, 0);
  const Pose2 before = state.pose();
  state.mean.head<3>() << known.map_from_base.x, known.map_from_base.y, known.map_from_base.yaw;
  for (PoseState::Matrix* matrix : {&state.covariance, &state.repeated}) {
    matrix->topRows<3>().setZero();
    matrix->leftCols<3>().setZero();
  }
  state.covariance.diagonal().head<3>() =
      Eigen::Vector3d(known.sigma_m, known.sigma_m, known.sigma_yaw_rad).cwiseAbs2();
  heard_.clear();
  compared_.reset();
  learnt_.reset();
  if (history_.empty()) {
    initial_ = state;
  } else {
    const Time now = history_.back().step.to;
    history_.clear();
    history_.push_back({.step = {.from = now, .to = now}, .state = state});
  }
  return ChangeOf(before, known.map_from_base);
}

FixResult PoseEstimator::Apply(const LandmarkFix& fix) {
  if (const auto refused = RefuseByForm(fix)) return *refused;
  const std::size_t index = EntryAt(fix.exposure);
  MeasurementUpdate update = Updated(history_[index].state, MeasurementOf(fix));
  const bool plausible = update.distance <= config_.gate_distance;
  LearnSlip(index, fix, update.distance);
  if (!plausible && Doubt(index)) update = Updated(history_[index].state, MeasurementOf(fix));

  FixResult result;
  result.distance = update.distance;
  result.change = ChangeOf(history_[index].state.pose(), update.state.pose());
  // Written so that NaN is refused.
  if (!(update.distance <= config_.gate_distance)) {
    result.verdict = FixVerdict::kImplausible;
    result.at_picture = EstimateAt(history_[index]);
    result.reason = fmt::format("distance {:.1f} from the estimate, allowed {:.1f}", update.distance,
                                config_.gate_distance);
    return result;
  }
  result.verdict = FixVerdict::kApplied;
  const std::size_t applied = Insert(index, update.state, fix);
  result.at_picture = EstimateAt(history_[applied]);
  Replay(applied + 1);
  if (TellsSlip(fix)) learnt_ = fix;
  return result;
}

/// A second fix for the same instant gets an entry of its own: replay applies one fix per entry.
std::size_t PoseEstimator::Insert(std::size_t index, const PoseState& state, const LandmarkFix& fix) {
  if (!history_[index].fix) {
    history_[index].state = state;
    history_[index].fix = fix;
    return index;
  }
  OdometryStep standing = history_[index].step;
  standing.from = standing.to;
  standing.noise.setZero();
  standing.wander = {};
  history_.insert(history_.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                  {.step = standing, .state = state, .fix = fix});
  return index + 1;
}

/// Takes back what was claimed since the fix before an entry, if by now the wheels are known to slip more.
bool PoseEstimator::Doubt(std::size_t index) {
  if (index == 0 || history_[index].slip >= slip_factor_) return false;
  std::size_t first = index;
  while (first > 1 && !history_[first - 1].fix) --first;
  for (std::size_t i = first; i < history_.size(); ++i)
    history_[i].slip = std::max(history_[i].slip, slip_factor_);
  Replay(first);
  return true;
}

namespace {

/// The covariance of a fix without what the fixes before and after it repeat: of that a part changes with the
/// place.
Eigen::Matrix3d OwnCovariance(const LandmarkFix& fix) {
  constexpr double kChanging = 0.25;
  return fix.covariance * (fix.own_share + kChanging * (1 - fix.own_share));
}

/// The variance of where the second fix has the base, across the base at the first one.
double AcrossVariance(const LandmarkFix& first, const LandmarkFix& second) {
  const Pose2 &a = first.base_from_landmark, &b = second.base_from_landmark;
  const double turn = a.yaw - b.yaw, c = std::cos(turn), s = std::sin(turn), lever = c * b.x - s * b.y;
  const Eigen::RowVector3d by_first(0, 1, -lever), by_second(-s, -c, lever);
  return (by_first * OwnCovariance(first) * by_first.transpose() +
          by_second * OwnCovariance(second) * by_second.transpose())
      .value();
}

bool IsSame(const Pose2& a, const Pose2& b) {
  return a.x == b.x && a.y == b.y && a.yaw == b.yaw;
}

}  // namespace

bool PoseEstimator::TellsSlip(const LandmarkFix& fix) {
  constexpr double kMostSigma_rad = Radians(0.3);
  return fix.covariance(2, 2) <= kMostSigma_rad * kMostSigma_rad;
}

/// By a fix at an entry, and the one before it. Right or wrong, one that is implausible makes the estimate
/// more cautious: wheels that slip more than is known make right ones implausible, and nothing but fixes
/// tells that they do. One that is far off tells nothing.
void PoseEstimator::LearnSlip(std::size_t index, const LandmarkFix& fix, double distance) {
  constexpr double kMostTurn_rad = 0.1, kLeast_m = 0.03, kMost_m = 1.5;
  if (!TellsSlip(fix) || !(distance < 2 * config_.gate_distance)) return;
  const std::optional<LandmarkFix>& before = learnt_;
  if (!before || before->exposure >= fix.exposure || before->exposure < history_.front().step.to) return;
  if (!IsSame(before->map_from_landmark, fix.map_from_landmark)) return;  // a plan is wrong between landmarks
  WheelsBetween wheels;
  for (std::size_t i = 0; i <= index; ++i)
    if (history_[i].step.to > before->exposure) wheels.Add(history_[i].step);
  if (!wheels.usable() || std::abs(wheels.driven().yaw) > kMostTurn_rad || wheels.forward_m() < kLeast_m ||
      wheels.forward_m() > kMost_m)
    return;
  const Pose2 moved = before->base_from_landmark * fix.base_from_landmark.Inverse();
  slip_.AddTurn({.change = WrapAngle(moved.yaw - wheels.driven().yaw),
                 .by_slip = wheels.turn_variance(),
                 .by_fixes = OwnCovariance(fix)(2, 2) + OwnCovariance(*before)(2, 2),
                 .forward_m = wheels.forward_m()});
  slip_.AddAcross({.change = moved.y - wheels.driven().y,
                   .by_slip = wheels.across_variance(),
                   .by_fixes = AcrossVariance(*before, fix),
                   .forward_m = wheels.forward_m()});
  slip_factor_ = slip_.factor();
}

/// At the last entry of that time: within one step of the odometry the base does not come nearer to a wall.
void PoseEstimator::Hear(const RingHeard& heard) {
  if (history_.empty() || heard.time < history_.front().step.to || heard.time <= newest_cycle_) return;
  newest_cycle_ = heard.time;
  const auto after = std::upper_bound(history_.begin(), history_.end(), heard.time,
                                      [](Time t, const Entry& entry) { return t < entry.step.to; });
  const auto index = static_cast<std::size_t>(after - history_.begin()) - 1;
  Entry& entry = history_[index];
  if (index == 0 || !entry.ranges.empty()) return;
  entry.ranges = heard.ranges;
  DropSilent(entry);
  const PoseState state = entry.lost ? WithoutWall(entry.state, *entry.lost) : entry.state;
  const CycleUpdate update = Updated(state, entry.ranges, config_.walls);
  for (std::size_t i = 0; i < heard_.size(); ++i)
    if (update.heard[i]) heard_[i] = heard.time;
  for (const WallSeen& wall : heard.walls) TakeUp(update.state, wall, entry);
  Replay(index);
  ComparePlan(index);
}

/// After the ranges, and before what is driven since: that is carried forward once more.
void PoseEstimator::ComparePlan(std::size_t index) {
  constexpr Duration kHeard = std::chrono::milliseconds(300);
  Entry& entry = history_[index];
  if (plan_.empty() || (compared_ && entry.step.to - *compared_ < FromSeconds(config_.plan.every_s))) return;
  std::bitset<PoseState::kMostWalls> heard;
  for (std::size_t i = 0; i < heard_.size(); ++i) heard[i] = entry.step.to - heard_[i] < kHeard;
  entry.matches = MatchPlan(entry.state, heard, plan_, config_.plan);
  if (entry.matches.empty()) return;
  compared_ = entry.step.to;
  plan_matches_ += static_cast<int>(entry.matches.size());
  for (const PlanMatch& match : entry.matches) entry.state = Updated(entry.state, match);
  Replay(index + 1);
}

/// The range of something else may fit where a wall once was: beyond its end, behind a door. So a wall that
/// was silent is found anew, by a series of ranges.
void PoseEstimator::DropSilent(Entry& entry) {
  const auto silent =
      std::ranges::find_if(heard_, [&](Time heard) { return entry.step.to - heard >= kUnheard; });
  if (silent != heard_.end()) Lose(static_cast<int>(silent - heard_.begin()), entry);
}

void PoseEstimator::Lose(int wall, Entry& entry) {
  entry.lost = wall;
  heard_.erase(heard_.begin() + wall);
}

/// A wall that is known is not taken up again; for another one the one that was heard longest ago gives way.
void PoseEstimator::TakeUp(const PoseState& state, const WallSeen& seen, Entry& entry) {
  if (entry.found || SameWall(state, seen)) return;
  if (static_cast<int>(heard_.size()) == PoseState::kMostWalls)
    Lose(static_cast<int>(std::ranges::min_element(heard_) - heard_.begin()), entry);
  entry.found = seen;
  heard_.push_back(entry.step.to);
}

std::optional<PoseEstimate> PoseEstimator::newest() const {
  if (history_.empty()) return std::nullopt;
  return EstimateAt(history_.back());
}

std::optional<FixResult> PoseEstimator::RefuseByForm(const LandmarkFix& fix) const {
  FixResult refused;
  const auto because = [&](FixVerdict verdict, std::string reason) {
    refused.verdict = verdict;
    refused.reason = std::move(reason);
    return refused;
  };
  if (!IsFinite(fix.base_from_landmark) || !IsFinite(fix.map_from_landmark) || !fix.covariance.allFinite())
    return because(FixVerdict::kImplausible, "not a finite pose");
  if (!(fix.own_share >= 0 && fix.own_share <= 1) ||
      MeasurementOf(fix).covariance.llt().info() != Eigen::Success)
    return because(FixVerdict::kImplausible, "its covariance makes no sense");
  if (history_.empty() || fix.exposure > history_.back().step.to)
    return because(FixVerdict::kTooNew, "no odometry for the time of the picture yet");
  refused.at_picture = EstimateAt(history_.back());
  if (fix.exposure < history_.front().step.to) {
    const double age_s = Seconds(history_.back().step.to - fix.exposure);
    return because(FixVerdict::kTooOld,
                   fmt::format("picture {:.1f} s old, odometry kept for {:.1f} s", age_s, config_.history_s));
  }
  for (const Entry& entry : history_) {
    if (entry.fix && entry.fix->exposure == fix.exposure && entry.fix->request_id == fix.request_id)
      return because(FixVerdict::kDouble, "this fix has been applied before");
  }
  return std::nullopt;
}

LandmarkMeasurement PoseEstimator::MeasurementOf(const LandmarkFix& fix) const {
  const Eigen::Vector3d least(config_.least_fix_sigma_m, config_.least_fix_sigma_m,
                              Radians(config_.least_fix_sigma_deg));
  LandmarkMeasurement measurement{fix.base_from_landmark, fix.covariance, fix.map_from_landmark,
                                  fix.own_share};
  measurement.covariance.diagonal() += least.cwiseAbs2();
  return measurement;
}

/// The last entry at `time`, which lies within the history; a step that contains it is cut there.
std::size_t PoseEstimator::EntryAt(Time time) {
  const auto after = std::upper_bound(history_.begin(), history_.end(), time,
                                      [](Time t, const Entry& entry) { return t < entry.step.to; });
  const auto index = static_cast<std::size_t>(after - history_.begin());
  if (history_[index - 1].step.to == time || after == history_.end()) return index - 1;
  const OdometryStep whole = after->step;
  // Between two entries there is only the step unless odometry paused: then the pose stood still.
  const OdometryStep first = Part(whole, whole.from, std::max(time, whole.from));
  const OdometryStep second = Part(whole, first.to, whole.to);
  const double slip = after->slip;
  after->step = second;
  history_.insert(
      after,
      {.step = first, .state = Propagated(history_[index - 1].state, first.Slipping(slip)), .slip = slip});
  return index;
}

void PoseEstimator::Replay(std::size_t from) {
  for (std::size_t i = from; i < history_.size(); ++i) {
    Entry& entry = history_[i];
    entry.state = Propagated(history_[i - 1].state, entry.step.Slipping(entry.slip));
    if (entry.lost) entry.state = WithoutWall(entry.state, *entry.lost);
    entry.state = Updated(entry.state, entry.ranges, config_.walls).state;
    if (entry.found) entry.state = WithWall(entry.state, *entry.found);
    for (const PlanMatch& match : entry.matches) entry.state = Updated(entry.state, match);
    if (!entry.fix) continue;
    entry.state = Updated(entry.state, MeasurementOf(*entry.fix)).state;
  }
}

PoseEstimate PoseEstimator::EstimateAt(const Entry& entry) const {
  return {entry.step.to, entry.state.pose(), Unbiased(entry.state, entry.step.twist),
          entry.state.pose_covariance()};
}

void PoseEstimator::Forget() {
  const Time oldest = history_.back().step.to - FromSeconds(config_.history_s);
  while (history_.size() > 2 && history_[1].step.to < oldest) history_.pop_front();
}

}  // namespace priamos::robot
