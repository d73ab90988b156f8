#include "head/core/doors/image_doors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/doors/outline_evidence.hpp"
#include "head/core/doors/outline_gauge.hpp"

namespace priamos::head {
namespace {

constexpr double kStands_m = 0.12;  ///< an upright that ends lower stands on the floor
constexpr double kSameShare = 0.4;  ///< of the narrower outline's breadth: doors that share more are one
constexpr double kHeightStep_m = 0.02;
constexpr std::size_t kMostOutlines = 250;  ///< the most promising; a door is among the first few dozens

/// An outline and what speaks for it.
struct Weighed {
  DoorOutline outline;
  OutlineEvidence evidence;
};

/// An outline at a scale.
struct Scaled {
  const Weighed* weighed = nullptr;
  double camera_m = 0, height_m = 0;  ///< of the camera and of the lintel above the floor
  double log_odds = 0;
};

class ImageDetector {
 public:
  ImageDetector(const CameraView& view, const CameraStand& stand, const Eigen::Matrix2d& covariance,
                const ImageDoorOptions& options)
      : options_(options),
        camera_(*view.camera),
        stand_(stand),
        covariance_(covariance),
        level_camera_(OnTheFloor(camera_, {0, stand.tilt_rad, stand.roll_rad})),
        level_(SeenFrom(view, level_camera_)) {
    std::vector<DoorOutline> outlines = FindOutlines(level_, options.outlines);
    std::stable_sort(outlines.begin(), outlines.end(),
                     [](const DoorOutline& a, const DoorOutline& b) { return Promise(a) > Promise(b); });
    if (outlines.size() > kMostOutlines) outlines.resize(kMostOutlines);
    const OutlineWeigher weigher(level_);
    for (const DoorOutline& outline : outlines) weighed_.push_back({outline, weigher.Weigh(outline)});
  }

  DoorsInImage Run(std::optional<double> told_m) const {
    DoorsInImage result;
    if (told_m)
      result.height_m = *told_m;
    else
      EstimateHeight(result);
    for (const Scaled& s : Best(At(result.height_m)))
      if (s.log_odds > options_.min_log_odds) result.doors.push_back(AsDoor(s, result.height_sigma_m));
    return result;
  }

 private:
  static double Promise(const DoorOutline& o) {
    return o.lintel_share + o.covered[0] + o.covered[1] - 0.05 * std::min(20.0, std::abs(o.first_px[0])) -
           0.05 * std::min(20.0, std::abs(o.first_px[1]));
  }

  std::optional<Scaled> At(const Weighed& w, double camera_m, double height_m) const {
    const double above = height_m - camera_m, width = above * w.outline.width();
    if (height_m < options_.min_height_m || height_m > options_.max_height_m || above < 0.1)
      return std::nullopt;
    if (width < options_.min_width_m || width > options_.max_width_m) return std::nullopt;
    return Scaled{&w, camera_m, height_m, OutlineLogOdds(w.outline, w.evidence, camera_m, height_m)};
  }

  /// Heights of the lintel that feet and level lines of the wall tell, and the usual one.
  std::vector<double> Heights(const Weighed& w, double camera_m) const {
    std::vector<double> all{options_.usual_height_m};
    for (int side = 0; side < 2; ++side)
      if (w.outline.falls[side] > 0.02)
        all.push_back(camera_m * (1 + w.outline.rises[side] / w.outline.falls[side]));
    for (const WallLine& line : w.evidence.wall_lines) all.push_back(camera_m * (1 + 1 / line.drop));
    return all;
  }

  std::vector<Scaled> At(double camera_m) const {
    std::vector<Scaled> all;
    for (const Weighed& w : weighed_) {
      std::optional<Scaled> best;
      for (const double height : Heights(w, camera_m))
        if (auto s = At(w, camera_m, height); s && (!best || s->log_odds > best->log_odds)) best = s;
      if (best) all.push_back(*best);
    }
    return all;
  }

  /// Middle between the uprights on the floor [m].
  static Eigen::Vector2d Middle(const Scaled& s) {
    const DoorOutline& o = s.weighed->outline;
    return (s.height_m - s.camera_m) * (o.At(0) + o.At(1)) / 2;
  }

  bool IsSame(const Scaled& a, const Scaled& b) const {
    if ((Middle(a) - Middle(b)).norm() < options_.same_door_m) return true;
    const auto breadth = [](const Scaled& s) {
      const double u = s.weighed->outline.corners[0].x(), v = s.weighed->outline.corners[1].x();
      return std::pair(std::min(u, v), std::max(u, v));
    };
    const auto [al, ah] = breadth(a);
    const auto [bl, bh] = breadth(b);
    return std::min(ah, bh) - std::max(al, bl) > kSameShare * std::min(ah - al, bh - bl);
  }

  /// The best ones that are not the same door.
  std::vector<Scaled> Best(std::vector<Scaled> sorted) const {
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Scaled& a, const Scaled& b) { return a.log_odds > b.log_odds; });
    std::vector<Scaled> best;
    for (const Scaled& s : sorted)
      if (std::none_of(best.begin(), best.end(), [&](const Scaled& d) { return IsSame(d, s); }))
        best.push_back(s);
    return best;
  }

  /// The height under which the image is likeliest, and how well that is known.
  void EstimateHeight(DoorsInImage& result) const {
    std::vector<std::pair<double, double>> all;  // height, log likelihood
    for (double h = options_.min_camera_m; h <= options_.max_camera_m; h += kHeightStep_m) {
      const double off = (h - options_.usual_camera_m) / options_.camera_sigma_m;
      double sum = -0.5 * off * off;
      for (const Scaled& s : Best(At(h))) sum += std::log1p(std::exp(std::min(50.0, s.log_odds)));
      all.emplace_back(h, sum);
    }
    const auto best = std::max_element(all.begin(), all.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    result.height_m = best->first;
    double sum = 0, spread = 0;
    for (const auto& [h, likely] : all) {
      const double weight = std::exp(likely - best->second);
      sum += weight;
      spread += weight * (h - best->first) * (h - best->first);
    }
    result.height_sigma_m = std::sqrt(spread / sum);
  }

  ImageDoor AsDoor(const Scaled& s, double camera_sigma_m) const {
    const DoorOutline& o = s.weighed->outline;
    const double above = s.height_m - s.camera_m;
    const OutlineGauge gauge = GaugeOutline(o, camera_, stand_, covariance_, options_.corner_sigma_px);
    const Eigen::Vector2d middle = Middle(s);
    ImageDoor door;
    door.corners = o.corners;
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d at = above * o.At(i);
      door.feet[i] = level_camera_.Project({at.x(), at.y(), -s.camera_m});
      door.on_floor |= o.foot_inside[i] && std::abs(above * o.falls[i] / o.rises[i] - s.camera_m) < kStands_m;
    }
    door.base_from_door = {middle.x(), middle.y(), gauge.yaw_rad};
    door.yaw_sigma_rad = gauge.yaw_sigma_rad;
    door.width_m = above * gauge.width;
    door.height_m = s.height_m;
    door.range_m = middle.norm();
    door.shape = door.width_m / door.height_m;
    door.log_odds = s.log_odds;
    AddScale(s, gauge, camera_sigma_m, door);
    return door;
  }

  /// What the scale does to range and shape. Feet tell the camera's height over the lintel's height above
  /// it; else the lintel's height is the usual one.
  void AddScale(const Scaled& s, const OutlineGauge& gauge, double camera_sigma_m, ImageDoor& door) const {
    const double above = s.height_m - s.camera_m, camera_share = s.camera_m / s.height_m,
                 lintel_share = options_.height_sigma_m / s.height_m;
    double above_share = 0, shape_share = 0;  // relative errors
    if (door.on_floor) {
      shape_share = options_.foot_share * camera_share;
      above_share = camera_sigma_m > 0 ? std::hypot(lintel_share, shape_share) : options_.foot_share;
    } else {
      const double sigma = std::hypot(options_.height_sigma_m, camera_sigma_m);
      above_share = sigma / above;
      shape_share = std::hypot(camera_share * lintel_share, camera_sigma_m / s.height_m) * s.height_m / above;
    }
    door.range_sigma_m = door.range_m * std::hypot(above_share, gauge.range_sigma / gauge.range);
    door.shape_sigma = door.shape * std::hypot(shape_share, gauge.width_sigma / gauge.width);
  }

  const ImageDoorOptions& options_;
  const CameraModel& camera_;
  CameraStand stand_;
  Eigen::Matrix2d covariance_;
  CameraModel level_camera_;
  CameraView level_;
  std::vector<Weighed> weighed_;
};

}  // namespace

DoorsInImage DetectDoorsInImage(const CameraView& view, const CameraStand& stand,
                                const Eigen::Matrix2d& covariance, std::optional<double> height_m,
                                const ImageDoorOptions& options) {
  return ImageDetector(view, stand, covariance, options).Run(height_m);
}

}  // namespace priamos::head
