#include "robot/core/sonar/approach_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace priamos::robot {
namespace {

constexpr double kJitter_s = 0.05;
constexpr std::ptrdiff_t kLeastFalls = 3;
constexpr double kBack_m = 0.03;  ///< noise; a leg that swings back is no longer the nearest
/// A neighbour hears the same thing from beside it.
constexpr double kNeighbourSlant = 0.2;

}  // namespace

void ApproachConfig::Describe(Archive& a) {
  a.Number("window_s", window_s, {"s", 0.3, 3, "echoes of so long tell whether something closes in"});
  a.Number("reach_m", reach_m, {"m", 0.1, 5, "echoes from farther away tell nothing"});
  a.Number("least_m_s", least_m_s, {"m/s", 0.02, 2, "what comes more slowly counts as standing"});
  a.Number("quick_s", quick_s, {"s", 0.2, 3, "as window_s, for who comes faster than quick_m_s"});
  a.Number("quick_m_s", quick_m_s,
           {"m/s", 0.1, 2, "who comes faster crosses the beams: fewer echoes decide"});
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

std::array<ApproachWatch::Rule, 2> ApproachWatch::Rules() const {
  return {{{config_.window_s, 5, config_.least_m_s, 0.1}, {config_.quick_s, 4, config_.quick_m_s, 0.2}}};
}

void ApproachWatch::Add(const SonarCycle& cycle, const Pose2& odom_from_base) {
  newest_ = cycle;
  const auto rules = Rules();
  for (std::size_t i = 0; i < heard_.size(); ++i) {
    auto& samples = heard_[i];
    while (!samples.empty() && Seconds(cycle.time - samples.front().time) > config_.window_s + kJitter_s)
      samples.pop_front();
    const bool heard = IsEcho(cycle.range_m[i]) && cycle.range_m[i] <= config_.reach_m;
    if (heard)
      samples.push_back({cycle.time, odom_from_base * BaseFromSonar(static_cast<int>(i), footprint_.Size()),
                         cycle.range_m[i]});
    for (std::size_t rule = 0; rule < rules.size(); ++rule)
      trends_[rule][i] = heard ? TrendOf(samples, rules[rule]) : std::nullopt;
  }
  for (int sensor = 0; sensor < kSonars; ++sensor) Note(sensor);
}

std::optional<ApproachWatch::Trend> ApproachWatch::TrendOf(const std::deque<Sample>& samples,
                                                           const Rule& rule) const {
  const Sample& newest = samples.back();
  const auto first = std::find_if(samples.begin(), samples.end(), [&](const Sample& s) {
    return Seconds(newest.time - s.time) <= rule.window_s + kJitter_s;
  });
  const double lasts_s = Seconds(newest.time - first->time);
  if (std::size_t(samples.end() - first) < rule.least_heard || lasts_s < 0.75 * rule.window_s)
    return std::nullopt;
  const Eigen::Vector2d axis = newest.odom_from_sonar.rotation().col(0);
  std::vector<double> falls;
  for (auto after = first + 1; after != samples.end(); ++after) {
    const auto before = after - 1;
    const Eigen::Vector2d driven =
        after->odom_from_sonar.translation() - before->odom_from_sonar.translation();
    falls.push_back(before->range_m - after->range_m - driven.dot(axis));
  }
  const Eigen::Vector2d ahead(newest.range_m, 0),
      driven = newest.odom_from_sonar * ahead - first->odom_from_sonar * ahead;
  return Trend{SpeedOf(falls, lasts_s), std::abs(axis.x() * driven.y() - axis.y() * driven.x()) / lasts_s,
               newest.range_m};
}

/// The largest step is left out: where one thing ends before another the place changes once. 0: not even.
double ApproachWatch::SpeedOf(const std::vector<double>& falls, double lasts_s) const {
  const auto [least, most] = std::minmax_element(falls.begin(), falls.end());
  const bool even = *least > -kBack_m && *most < config_.step_m &&
                    std::count_if(falls.begin(), falls.end(), [](double f) { return f > 0; }) >= kLeastFalls;
  const double fallen_m = std::accumulate(falls.begin(), falls.end(), -*most);
  return even ? fallen_m / (lasts_s * (1 - 1 / double(falls.size()))) : 0;
}

bool ApproachWatch::Agrees(int sensor, const Trends& trends, const Rule& rule) const {
  constexpr std::array kBeside{1, kSonars - 1};
  const auto& own = trends[static_cast<std::size_t>(sensor)];
  return std::any_of(kBeside.begin(), kBeside.end(), [&](int beside) {
    const auto& other = trends[static_cast<std::size_t>((sensor + beside) % kSonars)];
    return other && other->closing_m_s > rule.neighbour_m_s + kNeighbourSlant * other->across_m_s &&
           std::abs(other->range_m - own->range_m) < config_.agree_m;
  });
}

/// Of what closes in by a sensor; nullopt: nothing does.
std::optional<double> ApproachWatch::ClosingSpeed(int sensor) const {
  const auto rules = Rules();
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const auto& trend = trends_[i][static_cast<std::size_t>(sensor)];
    if (trend && trend->closing_m_s >= rules[i].least_m_s + config_.slant * trend->across_m_s &&
        Agrees(sensor, trends_[i], rules[i]))
      return trend->closing_m_s;
  }
  return std::nullopt;
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
  if (const auto closing_m_s = ClosingSpeed(sensor)) comer = Comer{now, now, *closing_m_s};
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
