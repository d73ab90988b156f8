#include "robot/core/sonar/echo_memory.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr int kPointsPerArc = 5;
constexpr std::size_t kCycles = 3;

}  // namespace

void EchoMemoryConfig::Describe(Archive& a) {
  a.Number("half_beam_deg", half_beam_deg, {"deg", 0, 30, "an echo lies anywhere within this of the axis"});
  a.Number("agreement_m", agreement_m,
           {"m", 0.01, 2, "two echoes this near to each other confirm one another"});
  a.Number("near_m", near_m, {"m", 0, 2, "an echo this near counts at once"});
  a.Number("blind_m", blind_m, {"m", 0, 0.5, "an echo up to here may come from nearer"});
  a.Number("blind_as_m", blind_as_m, {"m", 0, 0.5, "where such an echo is taken to come from"});
  a.Number("keep_s", keep_s, {"s", 0.05, 2, "how long an echo counts"});
  a.Number("bridge_from_m", bridge_from_m, {"m", 0, 2, "nearer echoes of neighbours are bridged"});
  a.Number("bridge_m", bridge_m, {"m", 0, 0.7, "if they are not farther apart than this"});
  a.Section("evidence", evidence, "a grid in which many echoes agree on places");
  a.Section("near_map", near_map, "places of near things that no beam sees any more");
}

EchoMemory::EchoMemory(const EchoMemoryConfig& config, const Footprint& footprint)
    : config_(config), near_map_(config.near_map), evidence_(config.evidence) {
  for (int i = 0; i < kSonars; ++i)
    base_from_sonar_[static_cast<std::size_t>(i)] = BaseFromSonar(i, footprint.Size());
}

void EchoMemory::Add(const SonarCycle& cycle, const Pose2& odom_from_base, const Stays& stays) {
  kept_.push_back({cycle, odom_from_base});
  if (kept_.size() > kCycles) kept_.pop_front();
  NoteNearThings(stays);
}

/// First what beams of this cycle see through, then what they see: a thing is not cleared by a neighbour that
/// sees it a little later.
void EchoMemory::NoteNearThings(const Stays& stays) {
  const std::size_t newest = kept_.size() - 1;
  for (const bool add : {false, true}) {
    for (int i = 0; i < kSonars; ++i) {
      if (!Agrees(newest, i)) continue;
      const Pose2 odom_from_sonar =
          kept_[newest].odom_from_base * base_from_sonar_[static_cast<std::size_t>(i)];
      if (add) {
        near_map_.Add(odom_from_sonar, RangeOf(newest, i));
        if (!stays || stays(odom_from_sonar * Eigen::Vector2d(RangeOf(newest, i), 0)))
          evidence_.Add(odom_from_sonar, RangeOf(newest, i), kept_[newest].cycle.time);
      } else {
        near_map_.Clear(odom_from_sonar, RangeOf(newest, i));
      }
    }
  }
}

void EchoMemory::Forget(const Pose2& odom_from_base, Time now, bool waits) {
  near_map_.Forget(odom_from_base, now, waits);
  while (!kept_.empty() && now - kept_.front().cycle.time > FromSeconds(config_.keep_s)) kept_.pop_front();
}

std::optional<Time> EchoMemory::newest() const {
  return kept_.empty() ? std::nullopt : std::optional(kept_.back().cycle.time);
}

std::vector<Eigen::Vector2d> EchoMemory::Points(const Pose2& odom_from_base) const {
  std::vector<Eigen::Vector2d> points;
  const double step = 2 * Radians(config_.half_beam_deg) / (kPointsPerArc - 1);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Pose2 base_from_then = odom_from_base.Inverse() * kept_[k].odom_from_base;
    for (int i = 0; i < kSonars; ++i) {
      if (!Agrees(k, i) || IsSuperseded(k, i)) continue;
      const double range = RangeOf(k, i);
      const Pose2 base_from_sonar = base_from_then * base_from_sonar_[static_cast<std::size_t>(i)];
      for (int p = 0; p < kPointsPerArc; ++p) {
        const double bearing = -Radians(config_.half_beam_deg) + p * step;
        points.push_back(base_from_sonar *
                         Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing)));
      }
    }
  }
  return points;
}

/// The newest believed echo of each sensor, on its axis, when it is near.
std::array<std::optional<Eigen::Vector2d>, kSonars> EchoMemory::NearEchoes(
    const Pose2& odom_from_base) const {
  std::array<std::optional<Eigen::Vector2d>, kSonars> near;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Pose2 base_from_then = odom_from_base.Inverse() * kept_[k].odom_from_base;
    for (int i = 0; i < kSonars; ++i) {
      const auto sensor = static_cast<std::size_t>(i);
      if (!Agrees(k, i)) continue;
      near[sensor].reset();
      if (RangeOf(k, i) <= config_.bridge_from_m)
        near[sensor] = base_from_then * base_from_sonar_[sensor] * Eigen::Vector2d(RangeOf(k, i), 0);
    }
  }
  return near;
}

std::vector<Eigen::Vector2d> EchoMemory::Bridges(const Pose2& odom_from_base) const {
  constexpr double kStep = 0.03;
  const auto near = NearEchoes(odom_from_base);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto &a = near[i], &b = near[(i + 1) % near.size()];
    if (!a || !b) continue;
    const double span = (*b - *a).norm();
    if (span > config_.bridge_m) continue;
    for (double travel = kStep; travel < span; travel += kStep)
      points.push_back(*a + (*b - *a) * (travel / span));
  }
  return points;
}

double EchoMemory::RangeOf(std::size_t index, int sensor) const {
  const double measured = kept_[index].cycle.range_m[static_cast<std::size_t>(sensor)];
  return measured <= config_.blind_m ? config_.blind_as_m : measured;
}

/// A newer believed echo of the same sensor shows where the thing is now.
bool EchoMemory::IsSuperseded(std::size_t index, int sensor) const {
  for (std::size_t k = index + 1; k < kept_.size(); ++k) {
    if (Agrees(k, sensor)) return true;
  }
  return false;
}

bool EchoMemory::Agrees(std::size_t index, int sensor) const {
  const double range = kept_[index].cycle.range_m[static_cast<std::size_t>(sensor)];
  if (!IsEcho(range)) return false;
  if (range < config_.near_m) return true;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    for (int offset = -1; offset <= 1; ++offset) {
      if (k == index && offset == 0) continue;
      const auto other = static_cast<std::size_t>((sensor + offset + kSonars) % kSonars);
      const double near_range = kept_[k].cycle.range_m[other];
      if (IsEcho(near_range) && std::abs(near_range - range) < config_.agreement_m) return true;
    }
  }
  return false;
}

}  // namespace priamos::robot
