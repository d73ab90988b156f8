#include "test/support/quad_scene.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace priamos::test {
namespace {

constexpr int kWidth = 768, kHeight = 576, kSamples = 8;
constexpr double kFrameX = -0.085, kWallX = -0.07, kStopX = 0.03, kBackX = 0.07;
constexpr double kTop = 2.0, kFrame = 0.06;

/// A quad as the camera sees it: maps an undistorted image point to (1, a, b) / depth.
struct Seen {
  Eigen::Matrix3d plane_from_image;
  double grey;
  bool is_triangle;
};

/// The grey value in one direction.
double Sample(const std::vector<Seen>& seen, const Eigen::Vector2d& at, double background, int* index) {
  double nearest = 0, grey = background;
  *index = -1;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Eigen::Vector3d y = seen[i].plane_from_image * at.homogeneous();
    if (y.x() <= nearest) continue;  // 1 / depth
    const double a = y.y() / y.x(), b = y.z() / y.x();
    if (a < 0 || a > 1 || b < 0 || b > 1 || (seen[i].is_triangle && a + b > 1)) continue;
    nearest = y.x(), grey = seen[i].grey, *index = static_cast<int>(i);
  }
  return grey;
}

Quad Upright(double x1, double y1, double x2, double y2, double z1, double z2, double grey) {
  return {{x1, y1, z1}, {x2 - x1, y2 - y1, 0}, {0, 0, z2 - z1}, grey};
}

void AddWallAround(std::vector<Quad>& quads, double half) {
  quads.push_back(Upright(kWallX, half, kWallX, 4, 0, 2.8, 170));
  quads.push_back(Upright(kWallX, -4, kWallX, -half, 0, 2.8, 170));
  quads.push_back(Upright(kWallX, -half, kWallX, half, kTop + kFrame, 2.8, 170));
}

void AddFloor(std::vector<Quad>& quads) {
  quads.push_back({{-8, -6, 0}, {16, 0, 0}, {0, 12, 0}, 95});
}

}  // namespace

cv::Mat RenderQuads(const std::vector<Quad>& quads, const Eigen::Isometry3d& base_from_scene,
                    const head::CameraModel& camera, double noise, Rng& rng, double background) {
  std::vector<Seen> seen;
  for (const Quad& quad : quads) {
    Eigen::Matrix3d image_from_plane;
    image_from_plane.col(0) = camera.image_from_base * (base_from_scene * quad.corner).homogeneous();
    const Eigen::Matrix3d m = camera.image_from_base.leftCols<3>();
    image_from_plane.col(1) = m * (base_from_scene.linear() * quad.u);
    image_from_plane.col(2) = m * (base_from_scene.linear() * quad.v);
    if (std::abs(image_from_plane.determinant()) > 1e-9)
      seen.push_back({image_from_plane.inverse(), quad.grey, quad.is_triangle});
  }
  cv::Mat index(kHeight, kWidth, CV_32SC1), image(kHeight, kWidth, CV_8UC1);
  cv::Mat value(kHeight, kWidth, CV_64FC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      value.at<double>(y, x) = Sample(seen, camera.Undistort({x, y}), background, &index.at<int>(y, x));
    }
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      bool mixed = false;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int u = std::clamp(x + dx, 0, kWidth - 1), v = std::clamp(y + dy, 0, kHeight - 1);
          mixed = mixed || index.at<int>(v, u) != index.at<int>(y, x);
        }
      }
      double grey = value.at<double>(y, x);
      if (mixed) {
        grey = 0;
        int ignored = 0;
        for (int k = 0; k < kSamples * kSamples; ++k) {
          const Eigen::Vector2d at(x + (k % kSamples + 0.5) / kSamples - 0.5,
                                   y + (k / kSamples + 0.5) / kSamples - 0.5);
          grey += Sample(seen, camera.Undistort(at), background, &ignored) / (kSamples * kSamples);
        }
      }
      image.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(grey + rng.Normal(noise));
    }
  }
  return image;
}

std::vector<Quad> DoorQuads(double width_m, double frame_m) {
  const double half = width_m / 2, outer = half + frame_m, otop = kTop + frame_m;
  std::vector<Quad> quads;
  AddWallAround(quads, outer);
  AddFloor(quads);
  quads.push_back(Upright(kFrameX, half, kFrameX, outer, 0, otop, 110));
  quads.push_back(Upright(kFrameX, -outer, kFrameX, -half, 0, otop, 110));
  quads.push_back(Upright(kFrameX, -half, kFrameX, half, kTop, otop, 110));
  quads.push_back(Upright(kFrameX, half, kStopX, half, 0, kTop, 70));
  quads.push_back(Upright(kFrameX, -half, kStopX, -half, 0, kTop, 150));
  quads.push_back({{kFrameX, -half, kTop}, {kStopX - kFrameX, 0, 0}, {0, width_m, 0}, 55});
  quads.push_back(Upright(kBackX, half + 0.015, kBackX, 4, 0, 2.8, 120));
  quads.push_back(Upright(kBackX, -4, kBackX, -half - 0.015, 0, 2.8, 120));
  quads.push_back(Upright(4, -3, 4, 3, 0, 2.8, 200));
  return quads;
}

std::vector<Quad> WallQuads() {
  std::vector<Quad> quads{Upright(kWallX, -4, kWallX, 4, 0, 2.8, 170)};
  AddFloor(quads);
  return quads;
}

head::LandmarkModel DoorModel(double width_m) {
  const double half = width_m / 2, outer = half + kFrame, otop = kTop + kFrame;
  const double from = kPi / 2 + 0.26, to = -kPi / 2 - 0.26;
  head::LandmarkModel model;
  model.id = 1;
  const auto jamb = [&](double x, double y, double height, double begin, double end) {
    model.edges.push_back({{x, y, 0}, {x, y, height}, begin, end, 1});
    model.edges.push_back({{x, -y, 0}, {x, -y, height}, -end, -begin, 2});
  };
  jamb(kFrameX, outer, otop, from, to);
  jamb(kFrameX, half, kTop, from, to);
  // The depth of the left jamb is seen from right of its face.
  jamb(kStopX, half, kTop, kPi - std::atan2(half - 0.2, 2.5), to);
  const auto lintel = [&](double x, double y, double z) {
    model.edges.push_back({{x, -y, z}, {x, y, z}, from, to, 0});
  };
  lintel(kFrameX, outer, otop);
  lintel(kFrameX, half, kTop);
  lintel(kStopX, half, kTop);
  return model;
}

head::CameraModel HeadCamera(double pan_rad, int side, double focal_px, double k1) {
  const Eigen::Rotation2Dd pan(pan_rad), turn(pan_rad - side * 0.02);
  const Eigen::Vector2d place = Eigen::Vector2d(0.25, 0) + pan * Eigen::Vector2d(0, 0.15 * side);
  const Eigen::Vector2d ahead = turn * Eigen::Vector2d(1, 0), left = turn * Eigen::Vector2d(0, 1);
  Eigen::Matrix3d camera_from_base;
  camera_from_base << -left.x(), -left.y(), 0, 0, 0, -1, ahead.x(), ahead.y(), 0;
  head::CameraModel camera;
  camera.centre_px = {383.5 + 4 * side, 290};
  Eigen::Matrix3d k;
  k << focal_px, 0, camera.centre_px.x(), 0, focal_px, camera.centre_px.y(), 0, 0, 1;
  camera.image_from_base.leftCols<3>() = k * camera_from_base;
  camera.image_from_base.col(3) =
      -camera.image_from_base.leftCols<3>() * Eigen::Vector3d(place.x(), place.y(), 1.2);
  camera.scale_px = focal_px;
  camera.k1 = k1;
  return camera;
}

}  // namespace priamos::test
