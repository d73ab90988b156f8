#include "test/bench/vision/visp_door.hpp"

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include "test/bench/vision/visp/visp_tracker.hpp"

namespace priamos::bench {
namespace {

Eigen::Isometry3d CameraFromBase(const head::CameraModel& camera) {
  Eigen::Matrix3d k;
  k << camera.scale_px, 0, camera.centre_px.x(), 0, camera.scale_px, camera.centre_px.y(), 0, 0, 1;
  const Eigen::Matrix<double, 3, 4> m = k.inverse() * camera.image_from_base;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m.leftCols<3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear() = svd.matrixU() * svd.matrixV().transpose();
  t.translation() = m.col(3);
  return t;
}

cv::Mat Undistorted(const cv::Mat& image, const head::CameraModel& camera) {
  cv::Mat map(image.size(), CV_32FC2), straight;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector2d p = camera.Distort(Eigen::Vector2d(x, y));
      map.at<cv::Vec2f>(y, x) = {static_cast<float>(p.x()), static_cast<float>(p.y())};
    }
  }
  cv::remap(image, straight, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return straight;
}

}  // namespace

VispFix FixWithVisp(const LandmarkLook& look, bool both_cameras) {
  const Eigen::Vector2d viewer = look.believed.Inverse().translation();
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;
  for (const head::LandmarkEdge& e : look.exact_model.edges)
    if (e.IsSeenFrom(viewer)) lines.emplace_back(e.from, e.to);
  std::vector<VispView> views;
  for (int c = 0; c < (both_cameras ? 2 : 1); ++c) {
    const head::CameraModel& camera = look.calibrated[c];
    views.push_back({Undistorted(look.images[c], camera), camera.scale_px, camera.centre_px,
                     CameraFromBase(camera) * head::Lift(look.believed)});
  }
  const VispResult result = TrackWithVisp(lines, views);
  const Eigen::Isometry3d t = CameraFromBase(look.calibrated[0]).inverse() * result.camera_from_model;
  return {result.ok,
          {t.translation().x(), t.translation().y(), std::atan2(t.linear()(1, 0), t.linear()(0, 0))},
          result.seconds};
}

}  // namespace priamos::bench
