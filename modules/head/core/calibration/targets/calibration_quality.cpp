#include "head/core/calibration/targets/calibration_quality.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

namespace {

constexpr std::size_t kFolds = 4;
constexpr double kSamePlace_m = 1e-6;

/// Calibrates without the points for which `left_out` holds and returns the summed error of those.
template <class LeftOut>
void Predict(const std::vector<DiscObservation>& observations, const LensKnowledge& lens,
             const LeftOut& left_out, double& sum, int& points, int& failed) {
  std::vector<DiscObservation> used;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!left_out(i)) used.push_back(observations[i]);
  }
  const Outcome<CameraCalibration> calibration = CalibrateFromDiscs(used, lens);
  if (!calibration) {
    ++failed;
    return;
  }
  const CameraModel& model = calibration->model;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (!left_out(i)) continue;
    const DiscObservation& o = observations[i];
    const Eigen::Vector2d shown = model.Distort(model.Project(o.disc.centre_m)) + CentroidBias(model, o.disc);
    sum += (o.centroid_px - shown).norm();
    ++points;
  }
}

}  // namespace

PredictionErrors PredictHeldOut(const std::vector<DiscObservation>& observations, const LensKnowledge& lens) {
  PredictionErrors errors;
  double sum = 0;
  int points = 0;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    Predict(
        observations, lens, [&](std::size_t i) { return i == k; }, sum, points, errors.failed);
  }
  if (points > 0) errors.leave_one_out_px = sum / points;
  sum = 0;
  points = 0;
  for (std::size_t k = 0; k < kFolds; ++k) {
    Predict(
        observations, lens, [&](std::size_t i) { return i % kFolds == k; }, sum, points, errors.failed);
  }
  if (points > 0) errors.held_out_px = sum / points;
  return errors;
}

ReconstructionErrors Reconstruct(std::span<const SeenPoint> points) {
  ReconstructionErrors errors;
  double squares = 0;
  for (const SeenPoint& p : points) {
    const auto reconstructed = Triangulate(p.rays);
    if (!reconstructed) continue;
    const double error = (*reconstructed - p.point_m).norm();
    errors.mean_m += error;
    squares += error * error;
    errors.max_m = std::max(errors.max_m, error);
    ++errors.points;
  }
  if (errors.points == 0) return errors;
  errors.mean_m /= errors.points;
  errors.rms_m = std::sqrt(squares / errors.points);
  return errors;
}

std::vector<SeenPoint> CommonPoints(std::span<const CameraCalibration> cameras) {
  std::vector<SeenPoint> points;
  for (const CameraCalibration& camera : cameras) {
    for (const DiscObservation& o : camera.observations) {
      const auto same = [&](const SeenPoint& p) {
        return (p.point_m - o.disc.centre_m).norm() < kSamePlace_m;
      };
      auto point = std::find_if(points.begin(), points.end(), same);
      if (point == points.end()) point = points.insert(points.end(), {o.disc.centre_m, {}});
      point->rays.push_back({&camera.model, o.centroid_px - CentroidBias(camera.model, o.disc)});
    }
  }
  std::erase_if(points, [](const SeenPoint& p) { return p.rays.size() < 2; });
  return points;
}

}  // namespace priamos::head
