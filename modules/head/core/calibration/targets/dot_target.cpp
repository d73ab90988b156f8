#include "head/core/calibration/targets/dot_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "head/core/calibration/discs/disc_detection.hpp"
#include "head/core/calibration/resection/camera_parameters.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kFewestPhotographs = 3;
constexpr double kPrintMisfit = 0.12;  // printed dots are no retro-reflectors: dust, gloss, shade
// Gloss within a dot may be as strong as what is a dot elsewhere: such a dot falls apart at a low contrast.
constexpr int kContrasts[] = {25, 40, 60, 80};

GreyImage Inverted(GreyImage image) {
  for (auto& p : image.pixels) p = static_cast<std::uint8_t>(255 - p);
  return image;
}

const DetectedDisc& Nearest(const std::vector<DetectedDisc>& discs, const cv::Point2f& at) {
  const Eigen::Vector2d p(at.x, at.y);
  return *std::min_element(discs.begin(), discs.end(), [&](const DetectedDisc& a, const DetectedDisc& b) {
    return (a.ellipse.centre_px - p).squaredNorm() < (b.ellipse.centre_px - p).squaredNorm();
  });
}

/// Whether rows are to be counted the other way round: only with y to the left of x as seen does z come out
/// of the dots towards the camera.
bool IsMirrored(const std::vector<cv::Point2f>& centres, const DotTarget& target) {
  const cv::Point2f x = centres[target.columns - 1] - centres[0];
  const cv::Point2f y = centres[centres.size() - static_cast<std::size_t>(target.columns)] - centres[0];
  return x.cross(y) > 0;  // image axes: v points down
}

CameraModel ModelFrom(const cv::Mat& k, const std::vector<double>& distortion, const cv::Mat& rotation,
                      const cv::Mat& translation) {
  cv::Mat r;
  cv::Rodrigues(rotation, r);
  Eigen::Matrix3d intrinsics, turn;
  Eigen::Matrix<double, 3, 4> pose;
  for (int i = 0; i < 9; ++i) {
    intrinsics(i / 3, i % 3) = k.at<double>(i / 3, i % 3);
    turn(i / 3, i % 3) = r.at<double>(i / 3, i % 3);
  }
  pose << turn,
      Eigen::Vector3d(translation.at<double>(0), translation.at<double>(1), translation.at<double>(2));
  CameraModel model;
  model.image_from_base = intrinsics * pose;
  model.centre_px = intrinsics.block<2, 1>(0, 2);
  model.scale_px = intrinsics(0, 0);
  model.k1 = distortion[0];
  model.k2 = distortion[1];
  return model;
}

/// Centres of the dots in the order of the grid; empty if it is not there as a whole.
std::vector<cv::Point2f> FindGrid(const std::vector<DetectedDisc>& discs, const DotTarget& target) {
  std::vector<cv::Point2f> candidates, centres;
  for (const DetectedDisc& d : discs)
    candidates.emplace_back(static_cast<float>(d.ellipse.centre_px.x()),
                            static_cast<float>(d.ellipse.centre_px.y()));
  const std::size_t wanted = static_cast<std::size_t>(target.columns) * target.rows;
  const bool found = candidates.size() >= wanted &&
                     cv::findCirclesGrid(candidates, {target.columns, target.rows}, centres,
                                         cv::CALIB_CB_SYMMETRIC_GRID, cv::Ptr<cv::FeatureDetector>());
  if (!found || centres.size() != wanted) centres.clear();
  return centres;
}

}  // namespace

Outcome<std::vector<DiscObservation>> FindDots(const GreyImage& photograph, const DotTarget& target) {
  const GreyImage image = target.dark ? Inverted(photograph) : photograph;
  DiscDetectorOptions options;
  options.max_misfit = kPrintMisfit;
  std::vector<DetectedDisc> discs;
  std::vector<cv::Point2f> centres;
  std::size_t most = 0;
  for (const int contrast : kContrasts) {
    options.min_contrast = contrast;
    discs = DetectDiscs(image, options);
    most = std::max(most, discs.size());
    centres = FindGrid(discs, target);
    if (!centres.empty()) break;
  }
  if (centres.empty())
    return Refusal{
        fmt::format("no grid of {} by {} dots among {} disc-like spots", target.columns, target.rows, most)};
  const bool mirrored = IsMirrored(centres, target);
  std::vector<DiscObservation> observations;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const int column = static_cast<int>(i) % target.columns, row = static_cast<int>(i) / target.columns;
    const DetectedDisc& d = Nearest(discs, centres[i]);
    const Eigen::Vector3d at(column * target.spacing_m, (mirrored ? -row : row) * target.spacing_m, 0);
    observations.push_back(
        {{at, Eigen::Vector3d::UnitZ(), target.radius_m}, d.ellipse.centre_px, std::max(0.005, d.sigma_px)});
  }
  return observations;
}

Outcome<std::vector<CameraCalibration>> CalibrateFromPlanes(
    const std::vector<std::vector<DiscObservation>>& photographs, int width_px, int height_px,
    const LensKnowledge& lens) {
  if (photographs.size() < kFewestPhotographs)
    return Refusal{fmt::format("{} photographs of a flat target, expected at least {}", photographs.size(),
                               kFewestPhotographs)};
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const auto& photograph : photographs) {
    points.emplace_back();
    pixels.emplace_back();
    for (const DiscObservation& o : photograph) {
      points.back().emplace_back(o.disc.centre_m.x(), o.disc.centre_m.y(), o.disc.centre_m.z());
      pixels.back().emplace_back(o.centroid_px.x(), o.centroid_px.y());
    }
  }
  cv::Mat k = cv::Mat::eye(3, 3, CV_64F);
  std::vector<double> distortion;
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::calibrateCamera(points, pixels, {width_px, height_px}, k, distortion, rotations, translations,
                        cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K3);
  } catch (const cv::Exception& error) {
    return Refusal{"the photographs do not determine a camera: " + std::string(error.err)};
  }
  std::vector<CameraCalibration> views;
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    CameraCalibration view;
    view.observations = photographs[i];
    view.discs = static_cast<int>(photographs[i].size());
    view.model = ModelFrom(k, distortion, rotations[i], translations[i]);
    if (!view.model.image_from_base.allFinite()) return Refusal{"the photographs do not determine a camera"};
    views.push_back(std::move(view));
  }
  // The second round knows the bias better.
  auto refined = ShareLens(std::move(views), lens);
  if (refined) refined = ShareLens(std::move(*refined), lens);
  if (!refined) return refined;
  for (const CameraCalibration& view : *refined)
    if (!(view.mean_error_px < lens.worst_error_px))
      return Refusal{
          fmt::format("the dots are {:.2f} px from where the best camera sees them", view.mean_error_px)};
  return refined;
}

Outcome<double> ErrorWithLens(const std::vector<DiscObservation>& photograph, const CameraModel& lens) {
  const auto parameters = ExtractParameters(lens.image_from_base);
  if (!parameters) return Refusal{parameters.reason()};
  const Eigen::Matrix3d intrinsics = parameters->Intrinsics();
  cv::Mat k(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) k.at<double>(i / 3, i % 3) = intrinsics(i / 3, i % 3);
  CameraModel model = lens;
  std::vector<Vector2d> bias(photograph.size(), Vector2d::Zero());
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<cv::Point3d> points;
    std::vector<cv::Point2d> pixels;
    for (std::size_t i = 0; i < photograph.size(); ++i) {
      const Eigen::Vector3d& p = photograph[i].disc.centre_m;
      const Vector2d straight = lens.Undistort(photograph[i].centroid_px - bias[i]);
      points.emplace_back(p.x(), p.y(), p.z());
      pixels.emplace_back(straight.x(), straight.y());
    }
    cv::Mat rotation, translation;
    if (!cv::solvePnP(points, pixels, k, cv::noArray(), rotation, translation))
      return Refusal{"no pose of the target fits"};
    const CameraModel posed = ModelFrom(k, {lens.k1, lens.k2}, rotation, translation);
    model.image_from_base = posed.image_from_base;
    for (std::size_t i = 0; i < photograph.size(); ++i) bias[i] = CentroidBias(model, photograph[i].disc);
  }
  double sum = 0;
  for (std::size_t i = 0; i < photograph.size(); ++i) {
    const Vector2d shown = model.Distort(model.Project(photograph[i].disc.centre_m)) + bias[i];
    sum += (photograph[i].centroid_px - shown).norm() / static_cast<double>(photograph.size());
  }
  return sum;
}

}  // namespace priamos::head
