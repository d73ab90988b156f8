#include "robot/core/sonar/wall_finder.hpp"

#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kOblique = 0.36;  ///< tangent of 20 degrees

}  // namespace

void WallFinderConfig::Describe(Archive& a) {
  a.Number("window_m", window_m, {"m", 0.2, 3, "least length of a series of ranges that shows a wall"});
  a.Number("most_m", most_m, {"m", 0.2, 5, "largest length of such a series"});
  a.Number("most_s", most_s, {"s", 1, 60, "an older range is no longer of the series"});
  a.Section("fit", fit, "which series is a wall's");
}

WallFinder::WallFinder(const WallFinderConfig& config, const Footprint& footprint) : config_(config) {
  for (int i = 0; i < kSonars; ++i)
    base_from_sonar_[static_cast<std::size_t>(i)] = BaseFromSonar(i, {footprint.length_m, footprint.width_m});
}

WallsHeard WallFinder::Add(const SonarCycle& cycle, const Pose2& odom_from_base) {
  WallsHeard heard;
  for (std::size_t i = 0; i < series_.size(); ++i) {
    Series& series = series_[i];
    while (!series.empty() && cycle.time - series.front().time > FromSeconds(config_.most_s))
      series.pop_front();
    if (!(cycle.range_m[i] > kSonarMin_m && cycle.range_m[i] <= kSonarMax_m)) continue;
    series.push_back({cycle.time, odom_from_base * base_from_sonar_[i], cycle.range_m[i]});
    while (LengthOf(series) > config_.most_m) series.pop_front();
    if (LengthOf(series) < config_.window_m) continue;
    if (const auto wall = WallOf(series, odom_from_base)) {
      heard.walls.push_back(*wall);
      heard.sensors.set(i);
    }
  }
  return heard;
}

std::optional<WallSeen> WallFinder::WallOf(const Series& series, const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<RangeAt> ranges;
  ranges.reserve(series.size());
  for (const Sample& sample : series)
    ranges.push_back({base_from_odom * sample.odom_from_sonar, sample.range_m});
  return FitWall(ranges, config_.fit);
}

/// How far the sensor went across its axis; 0 when it went along it, too. What a sensor hears at a slant is
/// where its beam meets something rough, not a perpendicular.
double WallFinder::LengthOf(const Series& series) {
  const Pose2& last = series.back().odom_from_sonar;
  const Eigen::Vector2d first = last.Inverse() * series.front().odom_from_sonar.translation();
  return std::abs(first.x()) < kOblique * std::abs(first.y()) ? std::abs(first.y()) : 0;
}

}  // namespace priamos::robot
