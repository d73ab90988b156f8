#include "head/core/calibration/targets/camera_calibration.hpp"

#include <fmt/format.h>

#include "head/core/calibration/discs/disc_detection.hpp"
#include "head/core/calibration/resection/dlt.hpp"

namespace priamos::head {

namespace {

using Eigen::Vector2d;

constexpr int kPasses = 3;  // the third changes thousandths of a pixel: the first two are those that count
constexpr double kSigmaFloor_px = 0.005;  // models of light and lens are not better than that

/// Pairs of points with the bias taken off and the model's distortion undone.
std::vector<PointPair> StraightPairs(const std::vector<DiscObservation>& observations,
                                     const std::vector<Vector2d>& bias, const CameraModel& model) {
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    pairs.push_back({observations[i].disc.centre_m, model.Undistort(observations[i].centroid_px - bias[i])});
  }
  return pairs;
}

std::vector<Vector2d> Biases(const std::vector<DiscObservation>& observations, const CameraModel& model) {
  std::vector<Vector2d> biases;
  biases.reserve(observations.size());
  for (const DiscObservation& o : observations) biases.push_back(CentroidBias(model, o.disc));
  return biases;
}

void FillErrors(const std::vector<Vector2d>& bias, CameraCalibration& c) {
  c.residuals_px.clear();
  c.mean_error_px = 0;
  for (std::size_t i = 0; i < c.observations.size(); ++i) {
    const DiscObservation& o = c.observations[i];
    c.residuals_px.push_back(o.centroid_px - bias[i] - c.model.Distort(c.model.Project(o.disc.centre_m)));
    c.mean_error_px += c.residuals_px.back().norm() / c.observations.size();
  }
}

}  // namespace

Outcome<CameraCalibration> CalibrateFromDiscs(const std::vector<DiscObservation>& observations,
                                              const LensKnowledge& lens) {
  CameraCalibration result;
  result.observations = observations;
  result.discs = static_cast<int>(observations.size());
  std::vector<Vector2d> bias(observations.size(), Vector2d::Zero());
  CameraModel lens_so_far;  // without distortion at first
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<PointPair> pairs = StraightPairs(observations, bias, lens_so_far);
    const auto dlt = SolveDlt(pairs);
    if (!dlt) return Refusal{dlt.reason()};
    if (pass == 0) result.dlt_error_px = MeanImageError(*dlt, pairs);
    CameraModel start = lens_so_far;
    start.image_from_base = *dlt;
    const Outcome<CameraModel> refined = RefineCamera(observations, bias, start, lens);
    if (!refined) return Refusal{refined.reason()};
    result.model = lens_so_far = *refined;
    if (pass + 1 < kPasses) bias = Biases(observations, *refined);
  }
  FillErrors(bias, result);
  if (!(result.mean_error_px < lens.worst_error_px)) {
    return Refusal{
        fmt::format("the discs are {:.2f} px from where the best camera sees them: object or "
                    "measurements are wrong",
                    result.mean_error_px)};
  }
  return result;
}

std::vector<DiscObservation> ObserveDiscs(const std::vector<DetectedDisc>& detections,
                                          const Labelling& labelling, const ReferenceObject& object,
                                          const Eigen::Isometry3d& base_from_object) {
  const ReferenceObject in_base = object.Moved(base_from_object);
  std::vector<DiscObservation> observations;
  for (const auto& [disc, detection] : labelling.labels) {
    const DetectedDisc& d = detections[detection];
    observations.push_back({in_base.discs[disc], d.ellipse.centre_px, std::max(kSigmaFloor_px, d.sigma_px)});
  }
  return observations;
}

Outcome<CameraCalibration> CalibrateCamera(const GreyImage& image, const ReferenceObject& object,
                                           const DiscLabeller& labeller,
                                           const Eigen::Isometry3d& base_from_object,
                                           const LensKnowledge& lens) {
  const std::vector<DetectedDisc> detections = DetectDiscs(image);
  const Outcome<Labelling> labelling = labeller.Label(detections);
  if (!labelling) return Refusal{labelling.reason()};
  return CalibrateFromDiscs(ObserveDiscs(detections, *labelling, object, base_from_object), lens);
}

Outcome<std::vector<CameraCalibration>> ShareLens(std::vector<CameraCalibration> calibrations,
                                                  const LensKnowledge& lens) {
  std::vector<std::vector<Vector2d>> biases;
  biases.reserve(calibrations.size());
  std::vector<RefinementView> views;
  for (const CameraCalibration& c : calibrations) biases.push_back(Biases(c.observations, c.model));
  for (std::size_t i = 0; i < calibrations.size(); ++i)
    views.push_back({calibrations[i].observations, biases[i], calibrations[i].model});
  const auto models = RefineViews(views, lens);
  if (!models) return Refusal{models.reason()};
  for (std::size_t i = 0; i < calibrations.size(); ++i) {
    calibrations[i].model = (*models)[i];
    FillErrors(biases[i], calibrations[i]);
  }
  return calibrations;
}

}  // namespace priamos::head
