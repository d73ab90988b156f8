#include "test/support/laser_floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "common/geometry.hpp"
#include "head/core/camera/head_model.hpp"

namespace priamos::support {
namespace {

using Eigen::Vector3d;

constexpr int kRays = 1600;
constexpr double kOnFloor_px = 1.5, kOnFront_px = 1.0;  ///< sigma of the line, lens included

/// Where one ray of the fan ends.
struct Spot {
  Vector3d at;
  int surface = 0;  ///< rays on different ones do not make one line
  double albedo = 1, sigma_px = kOnFloor_px;
};

class Tracer {
 public:
  explicit Tracer(const LaserFloor& scene) : scene_(scene) {}

  std::optional<Spot> Trace(const Vector3d& ray) const {
    double nearest = ToLevel(ray, 0);
    if (!(nearest > 0)) return std::nullopt;
    Spot spot{scene_.source + nearest * ray, 0, 1, kOnFloor_px};
    for (std::size_t i = 0; i < scene_.steps.size(); ++i) {
      const FloorStep& step = scene_.steps[i];
      const int surface = 1 + 2 * static_cast<int>(i);
      if (step.height_m < 0) {
        if (Within(step, spot.at)) return Bottom(step, ray, surface);
        continue;
      }
      const double top = ToLevel(ray, step.height_m), front = (step.x_from - scene_.source.x()) / ray.x();
      if (top > 0 && top < nearest && Within(step, scene_.source + top * ray)) {
        nearest = top;
        spot = {scene_.source + top * ray, surface, step.albedo, kOnFloor_px};
      }
      const Vector3d at = scene_.source + front * ray;
      const double above = at.z() - Floor(at);
      if (front > 0 && front < nearest && above >= 0 && above <= step.height_m && at.y() >= step.y_from &&
          at.y() <= step.y_to)
        nearest = front, spot = {at, surface + 1, step.albedo, kOnFront_px};
    }
    return spot;
  }

 private:
  double Floor(const Vector3d& p) const {
    return scene_.heave_m + scene_.pitch_rad * p.x() + scene_.roll_rad * p.y();
  }
  /// Distance along `ray`, in its lengths, to `height` [m] above the floor.
  double ToLevel(const Vector3d& ray, double height) const {
    const double slope = ray.z() - scene_.pitch_rad * ray.x() - scene_.roll_rad * ray.y();
    return (Floor(scene_.source) + height - scene_.source.z()) / slope;
  }
  static bool Within(const FloorStep& s, const Vector3d& p) {
    return p.x() >= s.x_from && p.x() <= s.x_to && p.y() >= s.y_from && p.y() <= s.y_to;
  }
  /// The point of the ray on the ground of a pit or on its far wall; none where its near edge hides that from
  /// the camera.
  std::optional<Spot> Bottom(const FloorStep& step, const Vector3d& ray, int surface) const {
    const double travel = std::min(ToLevel(ray, step.height_m), (step.x_to - scene_.source.x()) / ray.x());
    const Vector3d at = scene_.source + travel * ray;
    const Vector3d eye =
        -scene_.camera.image_from_base.leftCols<3>().inverse() * scene_.camera.image_from_base.col(3);
    const double depth = Floor(at) - at.z(), share = depth / (depth + eye.z() - Floor(eye));
    if (at.x() + share * (eye.x() - at.x()) < step.x_from) return std::nullopt;
    const bool wall = at.x() > step.x_to - 1e-9;
    return Spot{at, surface + (wall ? 1 : 0), step.albedo, wall ? kOnFront_px : kOnFloor_px};
  }

  const LaserFloor& scene_;
};

void DrawColumn(cv::Mat& grey, int u, double v, double amplitude, double sigma) {
  if (!(v > -20) || !(v < grey.rows + 20)) return;
  const int first = std::max(0, static_cast<int>(v - 5 * sigma));
  const int last = std::min(grey.rows - 1, static_cast<int>(v + 5 * sigma) + 1);
  for (int row = first; row <= last; ++row) {
    const double d = (row - v) / sigma;
    grey.at<float>(row, u) += static_cast<float>(amplitude * std::exp(-d * d / 2));
  }
}

/// What speckle does to the columns: brightness and place.
struct Speckle {
  std::vector<double> light, shift;

  Speckle(const LaserFloor& scene, Rng& rng) {
    double place = 0;
    for (int u = 0; u < scene.width; ++u) {
      light.push_back(std::max(0.2, 1 + rng.Normal(scene.speckle)));
      place = 0.7 * place + std::sqrt(1 - 0.49) * rng.Normal(scene.speckle_px);
      shift.push_back(place);
    }
  }
};

void DrawLine(const LaserFloor& scene, const head::LaserPlane& laser, cv::Mat& grey, Rng& rng) {
  const Speckle speckle(scene, rng);
  const Tracer tracer(scene);
  const Vector3d normal = laser.normal;
  const Vector3d across = normal.cross(Vector3d::UnitX()).normalized();
  const Vector3d middle = across.cross(normal).normalized();
  const Vector3d ahead = middle.x() > 0 ? middle : Vector3d(-middle);
  std::optional<Spot> last;
  Eigen::Vector2d last_px;
  for (int i = 0; i <= kRays; ++i) {
    const double angle = scene.half_angle_rad * (2.0 * i / kRays - 1);
    const auto spot = tracer.Trace(std::cos(angle) * ahead + std::sin(angle) * across);
    if (!spot || scene.camera.Depth(spot->at) < 0.1) {
      last.reset();
      continue;
    }
    const Eigen::Vector2d px = scene.camera.Distort(scene.camera.Project(spot->at));
    if (last && last->surface == spot->surface) {
      const Eigen::Vector2d &a = px.x() < last_px.x() ? px : last_px,
                            &b = px.x() < last_px.x() ? last_px : px;
      const int end = std::min(scene.width - 1, static_cast<int>(std::ceil(b.x())) - 1);
      for (int u = std::max(0, static_cast<int>(std::ceil(a.x()))); u <= end; ++u) {
        const double v = a.y() + (u - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
        DrawColumn(grey, u, v + speckle.shift[u], scene.amplitude * spot->albedo * speckle.light[u],
                   spot->sigma_px);
      }
    }
    last = spot;
    last_px = px;
  }
}

}  // namespace

head::LaserPlane FanTo(double distance_m, const Vector3d& source) {
  const double pitch = std::atan2(source.z(), distance_m - source.x());
  head::LaserPlane laser;
  laser.normal = {std::sin(pitch), 0, std::cos(pitch)};
  laser.offset_m = -laser.normal.dot(source);
  laser.pivot_m = {distance_m, 0, 0.05};
  return laser;
}

head::CameraModel ThirdCamera(double tilt_rad) {
  head::HeadSetting setting;
  setting.tilt_rad = tilt_rad;
  return head::MakeCameraModel({900, {383.5, 287.5}, -0.05, 0, 0.02},
                               head::HeadGeometry().BaseFromCamera(setting, head::kThird, 0.02));
}

LaserFloor NominalLaserFloor() {
  LaserFloor scene;
  scene.camera = ThirdCamera(0.62);
  head::LaserPlane laser;
  laser.normal = {std::sin(0.35), 0, std::cos(0.35)};
  laser.offset_m = -laser.normal.dot(scene.source);
  laser.pivot_m = {2.1, 0, 0.05};
  scene.lasers = {laser};
  return scene;
}

LaserFloor NominalLaserPair() {
  LaserFloor scene = NominalLaserFloor();
  scene.camera = ThirdCamera(0.54);
  scene.lasers.push_back(FanTo(3.0, scene.source));
  return scene;
}

GreyImage Render(const LaserFloor& scene, Rng& rng) {
  cv::Mat grey(scene.height, scene.width, CV_32FC1, cv::Scalar(scene.background));
  if (scene.texture != nullptr) {
    const int x =
        static_cast<int>(rng.Below(static_cast<std::uint64_t>(scene.texture->cols - scene.width + 1)));
    const int y =
        static_cast<int>(rng.Below(static_cast<std::uint64_t>(scene.texture->rows - scene.height + 1)));
    grey += (*scene.texture)({x, y, scene.width, scene.height});
  }
  if (scene.amplitude > 0) {
    for (const head::LaserPlane& laser : scene.lasers) DrawLine(scene, laser, grey, rng);
  }
  cv::Mat noise(grey.size(), CV_32FC1);
  cv::RNG fast(rng.Below(1u << 31));
  fast.fill(noise, cv::RNG::NORMAL, 0, scene.noise);
  grey += noise;
  cv::Mat bytes;
  grey.convertTo(bytes, CV_8U);
  return {scene.width, scene.height, {bytes.begin<std::uint8_t>(), bytes.end<std::uint8_t>()}};
}

cv::Mat FloorTexture(Rng& rng, int width, int height) {
  cv::Mat texture(height, width, CV_32FC1, cv::Scalar(0));
  cv::RNG fast(rng.Below(1u << 31));
  for (const double cell : {2.0, 6.0, 25.0, 90.0}) {
    cv::Mat coarse(static_cast<int>(height / cell) + 2, static_cast<int>(width / cell) + 2, CV_32FC1), fine;
    fast.fill(coarse, cv::RNG::NORMAL, 0, rng.Uniform(1, 6));
    cv::resize(coarse, fine, texture.size(), 0, 0, cv::INTER_CUBIC);
    texture += fine;
  }
  // Joints: dark, or bright between dark boards, along two directions.
  const double joint = rng.Uniform(-40, 25), spacing = rng.Uniform(60, 220), turn = rng.Uniform(-0.6, 0.6);
  cv::Mat marks(texture.size(), CV_32FC1, cv::Scalar(0));
  const int thick = 1 + static_cast<int>(rng.Below(4));
  for (const double angle : {turn, turn + kPi / 2}) {
    const cv::Point2d travel(std::cos(angle), std::sin(angle)), side(-travel.y, travel.x);
    for (double off = -1200; off < 1200; off += spacing) {
      const cv::Point2d at(width / 2.0 + off * side.x, height / 2.0 + off * side.y);
      cv::line(marks, cv::Point(at - 2000 * travel), cv::Point(at + 2000 * travel), cv::Scalar(joint), thick,
               cv::LINE_8);
    }
  }
  cv::GaussianBlur(marks, marks, {}, 0.9);
  texture += marks;
  // Reflections of lamps and windows: soft, sometimes long and narrow.
  cv::Mat shine(texture.size(), CV_32FC1, cv::Scalar(0));
  const int n = static_cast<int>(rng.Below(4));
  for (int i = 0; i < n; ++i) {
    const cv::Point at(static_cast<int>(rng.Uniform(0, width)), static_cast<int>(rng.Uniform(0, height)));
    const cv::Size axes(static_cast<int>(rng.Uniform(30, 250)), static_cast<int>(rng.Uniform(8, 60)));
    cv::ellipse(shine, at, axes, rng.Uniform(0, 180), 0, 360, cv::Scalar(rng.Uniform(20, 120)), cv::FILLED);
  }
  cv::GaussianBlur(shine, shine, {}, rng.Uniform(4, 12));
  texture += shine;
  return texture;
}

}  // namespace priamos::support
