#include "robot/core/sonar/approach_watch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::robot {
namespace {

constexpr std::size_t kLeastHeard = 5;
constexpr std::ptrdiff_t kLeastFalls = 3;
constexpr double kBack_m = 0.03;  ///< noise; a leg that swings back is no longer the nearest
/// What a neighbour that hears the same thing from beside it must show.
constexpr double kNeighbour_m_s = 0.1, kNeighbourSlant = 0.2;

}  // namespace

void ApproachConfig::Describe(Archive& a) {
  a.Number("window_s", window_s, {"s", 0.3, 3, "echoes of so long tell whether something closes in"});
  a.Number("reach_m", reach_m, {"m", 0.1, 5, "echoes from farther away tell nothing"});
  a.Number("least_m_s", least_m_s, {"m/s", 0.02, 2, "what comes more slowly counts as standing"});
  a.Number("slant", slant,
           {"-", 0, 5, "so does what comes by less than this part of the speed across the beam"});
  a.Number("step_m", step_m, {"m", 0.05, 1, "a larger change from echo to echo is another thing"});
  a.Number("agree_m", agree_m, {"m", 0.05, 1, "ranges of neighbours that hear one thing differ by less"});
  a.Number("body_m", body_m, {"m", 0, 1, "feet and shoulders reach so far beyond the echo"});
  a.Number("touch_m", touch_m, {"m", 0, 1, "who has come and is heard nearer may touch with the trunk"});
  a.Number("near_m", near_m, {"m", 0, 1, "who has come and is heard nearer has not gone"});
  a.Number("wait_s", wait_s, {"s", 0, 60, "and is waited for, for so long since he came"});
  a.Number("gone_s", gone_s, {"s", 0, 10, "so long nothing closes in, and nothing is near: he has gone"});
}

ApproachWatch::ApproachWatch(const ApproachConfig& config, const Footprint& footprint)
    : config_(config), footprint_(footprint) {}

void ApproachWatch::Add(const SonarCycle& cycle, const Pose2& odom_from_base) {
  constexpr double kJitter_s = 0.05;
  for (std::size_t i = 0; i < heard_.size(); ++i) {
    auto& samples = heard_[i];
    while (!samples.empty() && Seconds(cycle.time - samples.front().time) > config_.window_s + kJitter_s)
      samples.pop_front();
    trends_[i].reset();
    if (!IsEcho(cycle.range_m[i]) || cycle.range_m[i] > config_.reach_m) continue;
    samples.push_back({cycle.time, odom_from_base * BaseFromSonar(static_cast<int>(i), footprint_.Size()),
                       cycle.range_m[i]});
    trends_[i] = TrendOf(samples);
  }
  newest_ = cycle;
  for (int sensor = 0; sensor < kSonars; ++sensor) Note(sensor);
}

/// The largest step is left out: where one thing ends before another the place changes once.
std::optional<ApproachWatch::Trend> ApproachWatch::TrendOf(const std::deque<Sample>& samples) const {
  const double lasts_s = Seconds(samples.back().time - samples.front().time);
  if (samples.size() < kLeastHeard || lasts_s < 0.75 * config_.window_s) return std::nullopt;
  const Sample& newest = samples.back();
  const Eigen::Vector2d axis = newest.odom_from_sonar.rotation().col(0);
  std::vector<double> falls;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Sample &before = samples[k - 1], &after = samples[k];
    const Eigen::Vector2d driven =
        after.odom_from_sonar.translation() - before.odom_from_sonar.translation();
    falls.push_back(before.range_m - after.range_m - driven.dot(axis));
  }
  const auto [least, most] = std::minmax_element(falls.begin(), falls.end());
  const bool even = *least > -kBack_m && *most < config_.step_m &&
                    std::count_if(falls.begin(), falls.end(), [](double f) { return f > 0; }) >= kLeastFalls;
  const Eigen::Vector2d ahead(newest.range_m, 0),
      driven = newest.odom_from_sonar * ahead - samples.front().odom_from_sonar * ahead;
  double fallen_m = -*most;
  for (const double fall : falls) fallen_m += fall;
  const double counted_s = lasts_s * (1 - 1 / double(falls.size()));
  return Trend{even ? fallen_m / counted_s : 0,
               std::abs(axis.x() * driven.y() - axis.y() * driven.x()) / lasts_s, newest.range_m};
}

bool ApproachWatch::Agrees(int sensor) const {
  const auto& own = trends_[static_cast<std::size_t>(sensor)];
  constexpr std::array kBeside{1, kSonars - 1};
  return std::any_of(kBeside.begin(), kBeside.end(), [&](int beside) {
    const auto& other = trends_[static_cast<std::size_t>((sensor + beside) % kSonars)];
    return other && other->closing_m_s > kNeighbour_m_s + kNeighbourSlant * other->across_m_s &&
           std::abs(other->range_m - own->range_m) < config_.agree_m;
  });
}

bool ApproachWatch::Closes(int sensor) const {
  const auto& trend = trends_[static_cast<std::size_t>(sensor)];
  return trend && trend->closing_m_s >= config_.least_m_s + config_.slant * trend->across_m_s &&
         Agrees(sensor);
}

/// Whoever stands beside the beam by which he came is heard by the next one.
bool ApproachWatch::IsNearer(int sensor, double than_m) const {
  constexpr std::array kAround{0, 1, kSonars - 1};
  return std::any_of(kAround.begin(), kAround.end(), [&](int beside) {
    const double range_m = RangeOf((sensor + beside) % kSonars);
    return IsEcho(range_m) && range_m < than_m;
  });
}

void ApproachWatch::Note(int sensor) {
  auto& comer = comers_[static_cast<std::size_t>(sensor)];
  const Time now = newest_.time;
  if (Closes(sensor))
    comer = Comer{now, now, trends_[static_cast<std::size_t>(sensor)]->closing_m_s};
  if (!comer) return;
  if (IsNearer(sensor, config_.near_m)) comer->heard = now;
  if (now - comer->heard > FromSeconds(config_.gone_s) || now - comer->closed > FromSeconds(config_.wait_s))
    comer.reset();
}

bool ApproachWatch::Meets(const Eigen::Vector2d& velocity, double within_s) const {
  for (int sensor = 0; sensor < kSonars; ++sensor) {
    if (!comers_[static_cast<std::size_t>(sensor)]) continue;
    if (IsNearer(sensor, config_.near_m) || Comes(sensor, velocity, within_s)) return true;
  }
  return false;
}

bool ApproachWatch::MayTouch() const {
  for (int sensor = 0; sensor < kSonars; ++sensor)
    if (comers_[static_cast<std::size_t>(sensor)] && IsNearer(sensor, config_.touch_m)) return true;
  return false;
}

bool ApproachWatch::Comes(int sensor, const Eigen::Vector2d& velocity, double within_s) const {
  constexpr int kLooked = 15;
  const Comer& comer = *comers_[static_cast<std::size_t>(sensor)];
  if (!IsEcho(RangeOf(sensor)) || newest_.time - comer.closed > FromSeconds(config_.gone_s)) return false;
  const Pose2 base_from_sonar = BaseFromSonar(sensor, footprint_.Size());
  const Eigen::Vector2d axis = base_from_sonar.rotation().col(0);
  const Eigen::Vector2d at = base_from_sonar.translation() + RangeOf(sensor) * axis;
  const Eigen::Vector2d relative = -comer.closing_m_s * axis - velocity;
  for (int i = 0; i <= kLooked; ++i)
    if (footprint_.Distance(at + within_s * i / kLooked * relative) < config_.body_m) return true;
  return false;
}

}  // namespace priamos::robot
