#include "head/core/scene/level_borders.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

constexpr double kLeastHeightVariance_m2 = 1e-7;  ///< keeps the covariances of exact edges invertible
constexpr double kHeightSigmas = 3;
constexpr double kPictureBorder_px = 4;  ///< what ends nearer to it may go on
constexpr double kSameBorder_rad = 0.05, kSameBorder_m = 0.02;

/// Height of an edge that is level, weighed by both ends, or nothing when they differ too much.
struct Height {
  double at_m, sigma_m;
};
std::optional<Height> LevelOf(const SpaceEdge& edge, double slope) {
  Eigen::Matrix2d covariance;
  covariance << edge.covariance(2, 2), edge.covariance(2, 5), edge.covariance(5, 2), edge.covariance(5, 5);
  covariance.diagonal().array() += kLeastHeightVariance_m2;
  const double rise = edge.to.z() - edge.from.z(), run = (edge.to - edge.from).head<2>().norm();
  const double spread = covariance(0, 0) + covariance(1, 1) - 2 * covariance(0, 1);
  if (std::abs(rise) > slope * run + kHeightSigmas * std::sqrt(std::max(0.0, spread))) return std::nullopt;
  const Eigen::Vector2d weight = covariance.inverse() * Eigen::Vector2d::Ones();
  const double information = weight.sum();
  if (!(information > 0)) return std::nullopt;
  return Height{weight.dot(Eigen::Vector2d(edge.from.z(), edge.to.z())) / information,
                1 / std::sqrt(information)};
}

class BorderSearch {
 public:
  BorderSearch(const StereoViews& views, const CameraView& third, const LevelBorderOptions& options)
      : views_(views),
        third_(third),
        options_(options),
        eye_(OpticalCentre(*views[0].camera)),
        ray_from_image_(views[0].camera->image_from_base.leftCols<3>().inverse()) {}

  std::vector<LevelBorder> Run(std::span<const StereoMatch> matches) {
    for (const StereoMatch& match : matches)
      if (match.space) AddTriangulated(match);
    // What corners lead to has corners of its own.
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      const LevelBorder border = borders_[i];
      for (const bool at_to : {false, true})
        if (at_to ? border.to_ends : border.from_ends) FollowCorner(border, at_to);
    }
    return std::move(borders_);
  }

 private:
  /// Where the line of sight through a point of the left image has a height; nullopt when it never has.
  std::optional<Eigen::Vector2d> AtHeight(const Eigen::Vector2d& image, double z) const {
    const Eigen::Vector3d ray = ray_from_image_ * image.homogeneous();
    const double along = (z - eye_.z()) / ray.z();
    if (!std::isfinite(along)) return std::nullopt;
    const Eigen::Vector3d at = eye_ + along * ray;
    if (views_[0].camera->Depth(at) <= 0 || (at - eye_).norm() > options_.max_distance_m) return std::nullopt;
    return at.head<2>();
  }

  bool IsInPicture(const Eigen::Vector2d& at) const {
    const ImageSize& size = views_[0].size;
    return at.x() > kPictureBorder_px && at.y() > kPictureBorder_px &&
           at.x() < size.width - 1 - kPictureBorder_px && at.y() < size.height - 1 - kPictureBorder_px;
  }

  Eigen::Vector2d ImageOf(const Eigen::Vector2d& at, double z) const {
    return views_[0].camera->Project({at.x(), at.y(), z});
  }

  /// The border that an image line is, at a height.
  std::optional<LevelBorder> AsBorder(const ViewLine& line, const Height& height) const {
    const auto from = AtHeight(line.p, height.at_m), to = AtHeight(line.q, height.at_m);
    if (!from || !to) return std::nullopt;
    return LevelBorder{*from, *to, height.at_m, height.sigma_m, IsInPicture(line.p), IsInPicture(line.q)};
  }

  bool IsInHeight(double z) const {
    return z > options_.low_m && z < options_.high_m && std::abs(z - eye_.z()) > options_.below_eye_m;
  }

  void AddTriangulated(const StereoMatch& match) {
    const auto height = LevelOf(*match.space, options_.slope);
    if (!height || !IsInHeight(height->at_m) || height->sigma_m > options_.max_sigma_m) return;
    const auto border = AsBorder(views_[0].lines[match.left], *height);
    if (border && border->length_m() > options_.min_length_m && IsSeenThere(*border)) Add(*border);
  }

  /// Lines of the left image that begin where a border ends.
  void FollowCorner(const LevelBorder& border, bool at_to) {
    const Eigen::Vector2d corner = at_to ? border.to : border.from, image = ImageOf(corner, border.height_m);
    for (const ViewLine& line : views_[0].lines) {
      const double p = (line.p - image).norm(), q = (line.q - image).norm();
      if (std::min(p, q) > options_.corner_px) continue;
      auto next = AsBorder(line, {border.height_m, border.sigma_m});
      if (!next || next->length_m() < options_.min_length_m) continue;
      const double off = std::asin(std::clamp(next->direction().dot(border.direction()), -1.0, 1.0));
      if (std::abs(off) > options_.square_rad || !IsSeenThere(*next)) continue;
      Add(*next);
    }
  }

  /// Whether all images show it, and that it ends there.
  bool IsSeenThere(const LevelBorder& border) const {
    const Eigen::Vector3d from(border.from.x(), border.from.y(), border.height_m),
        to(border.to.x(), border.to.y(), border.height_m);
    const auto shows = [&](const CameraView& view) {
      return CoverIn(view, from, to) > options_.min_cover &&
             EndsIn(view, from, to, EndRule::kStop, options_.ends);
    };
    return shows(views_[0]) && shows(views_[1]) && shows(third_);
  }

  void Add(const LevelBorder& border) {
    const bool known = std::any_of(borders_.begin(), borders_.end(), [&](const LevelBorder& other) {
      return std::abs(other.height_m - border.height_m) < kSameBorder_m &&
             std::abs(other.direction().dot(border.direction())) > std::cos(kSameBorder_rad) &&
             DistanceTo(other, border.from) < kSameBorder_m && DistanceTo(other, border.to) < kSameBorder_m;
    });
    if (!known) borders_.push_back(border);
  }

  static double DistanceTo(const LevelBorder& border, const Eigen::Vector2d& at) {
    return DistanceToSegment(border.from, border.to, at);
  }

  const StereoViews& views_;
  const CameraView& third_;
  const LevelBorderOptions& options_;
  Eigen::Vector3d eye_;
  Eigen::Matrix3d ray_from_image_;
  std::vector<LevelBorder> borders_;
};

}  // namespace

std::vector<LevelBorder> FindLevelBorders(const StereoViews& views, const CameraView& third,
                                          std::span<const StereoMatch> matches,
                                          const LevelBorderOptions& options) {
  return BorderSearch(views, third, options).Run(matches);
}

}  // namespace priamos::head
