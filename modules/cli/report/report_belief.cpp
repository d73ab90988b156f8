#include "cli/report/report_belief.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/report/report_timeline.hpp"
#include "common/covariance.hpp"

namespace priamos::cli {
namespace {

/// A pose farther from the crossing in time says nothing of it: poses come at 50 Hz.
constexpr std::int64_t kNear_us = 100'000;

const pose_t* NearestPose(const RunRecord& record, std::int64_t utime) {
  const auto distance = [&](const pose_t& pose) { return std::abs(pose.utime - utime); };
  const auto nearest =
      std::min_element(record.poses.begin(), record.poses.end(),
                       [&](const pose_t& a, const pose_t& b) { return distance(a) < distance(b); });
  return nearest != record.poses.end() && distance(*nearest) <= kNear_us ? &*nearest : nullptr;
}

/// A fix that makes no sense as a number is implausible, too, but was never compared: it has no distance.
bool WasCompared(const pose_correction_t& correction) {
  if (!std::isfinite(correction.distance)) return false;
  return correction.verdict == pose_correction_t::APPLIED ||
         (correction.verdict == pose_correction_t::IMPLAUSIBLE && correction.distance > 0);
}

}  // namespace

std::optional<BeliefAtDoor> BeliefAt(const RunRecord& record, const DoorPlan& door, std::int64_t utime) {
  const pose_t* pose = NearestPose(record, utime);
  const auto truth = pose ? TruthAt(record, pose->utime) : std::nullopt;
  if (!truth) return std::nullopt;
  const Eigen::Matrix3d covariance = CovarianceIn(*pose);
  const Eigen::LLT<Eigen::Matrix3d> root(covariance);
  if (root.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error(pose->x_m - truth->x, pose->y_m - truth->y,
                              WrapAngle(pose->yaw_rad - truth->yaw));
  const double yaw = door.map_from_door().yaw;
  const Eigen::Vector3d across(-std::sin(yaw), std::cos(yaw), 0), along(std::cos(yaw), std::sin(yaw), 0);
  return BeliefAtDoor{.lateral_m = across.dot(error),
                      .along_m = along.dot(error),
                      .heading_rad = error.z(),
                      .lateral_sigma_m = std::sqrt(across.dot(covariance * across)),
                      .nees = error.dot(root.solve(error))};
}

CorrectionSummary CorrectionsOf(const RunRecord& record) {
  CorrectionSummary summary;
  for (const pose_correction_t& correction : record.corrections) {
    if (!WasCompared(correction)) continue;
    ++summary.count;
    summary.beyond_3_sigma += correction.distance > kThreeSigmas;
    summary.most_distance = std::max(summary.most_distance, correction.distance);
  }
  return summary;
}

nlohmann::ordered_json ToJson(const CorrectionSummary& corrections) {
  return {{"count", corrections.count},
          {"beyond_3_sigma", corrections.beyond_3_sigma},
          {"most_distance", corrections.most_distance}};
}

}  // namespace priamos::cli
