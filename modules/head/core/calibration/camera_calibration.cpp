#include "head/core/calibration/camera_calibration.hpp"

#include <vector>

#include "head/core/calibration/disc_detection.hpp"
#include "head/core/calibration/dlt.hpp"

namespace priamos::head {
namespace {

constexpr int kPasses = 2;  // the bias needs a camera, the camera the unbiased points
constexpr int kFitSteps = 20;
constexpr double kCentreSigmaPx = 20, kK1Sigma = 0.1;  // what is known of a lens beforehand

/// The measured centroids with the bias of the discs taken out, in the object's frame.
std::vector<PointPair> UnbiasedPoints(const std::vector<DetectedDisc>& detections, const Labelling& labelling,
                                      const ReferenceObject& object, const PinholeView& view) {
  const CameraModel camera = view.Model();
  std::vector<PointPair> pairs;
  for (const Label& label : labelling.labels) {
    const ReferenceDisc& disc = object.discs[label.disc];
    pairs.push_back(
        {disc.centre_m, detections[label.detection].ellipse.centre_px - CentroidBias(camera, disc)});
  }
  return pairs;
}

}  // namespace

Outcome<CameraCalibration> CalibrateCamera(const GreyImage& image, const ReferenceObject& object,
                                           const DiscLabeller& labeller,
                                           const Eigen::Isometry3d& base_from_object) {
  const auto detections = DetectDiscs(image);
  const auto labelling = labeller.Label(detections);
  if (!labelling) return Refusal{labelling.reason()};
  PinholeView view = labelling->view;
  std::vector<PointPair> pairs;
  for (int pass = 0; pass < kPasses; ++pass) {
    pairs = UnbiasedPoints(detections, *labelling, object, view);
    LensPrior lens;
    lens.focal_log_sigma = 1;
    lens.centre_sigma_px = kCentreSigmaPx;
    lens.k1_sigma = kK1Sigma;
    FitView(view, pairs, lens, kFitSteps, 0.05);
  }
  CameraCalibration result{view.Model(), static_cast<int>(pairs.size()), 0};
  for (PointPair& pair : pairs) {
    pair.image_px = result.model.Undistort(pair.image_px);
    pair.point_m = base_from_object * pair.point_m;
  }
  const auto matrix = SolveDlt(pairs);
  if (!matrix) return Refusal{matrix.reason()};
  result.model.image_from_base = *matrix;
  result.mean_error_px = MeanImageError(*matrix, pairs);
  return result;
}

}  // namespace priamos::head
