#include "head/core/scene/table_tops.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::head {
namespace {

constexpr double kTopSigmas = 3;

/// A rectangle at a height that grows by borders, aligned with the first one.
class Top {
 public:
  Top(const LevelBorder& first, const TableTopOptions& options)
      : origin_(first.from), along_(first.direction()), first_(first), options_(options) {
    Take(first);
  }

  const LevelBorder& first() const { return first_; }
  /// Lengths along the first border and across it.
  Eigen::Vector2d size_m() const { return box_.sizes(); }
  Eigen::Vector2d along() const { return along_; }
  Eigen::Vector2d across() const { return {-along_.y(), along_.x()}; }
  Eigen::Vector2d centre() const {
    return origin_ + box_.center().x() * along_ + box_.center().y() * across();
  }

  bool Has(const LevelBorder& border) const {
    const double sigma = std::hypot(border.sigma_m, first_.sigma_m);
    if (std::abs(border.height_m - first_.height_m) > options_.same_height_m + kTopSigmas * sigma)
      return false;
    const double off = std::abs(border.direction().dot(along_)), least = std::sin(options_.square_rad);
    if (off > least && off < std::cos(options_.square_rad)) return false;
    Eigen::AlignedBox2d other(In(border.from));
    other.extend(In(border.to));
    return box_.exteriorDistance(other) < options_.apart_m;
  }
  void Take(const LevelBorder& border) {
    box_.extend(In(border.from));
    box_.extend(In(border.to));
  }

 private:
  Eigen::Vector2d In(const Eigen::Vector2d& at) const {
    return {along_.dot(at - origin_), across().dot(at - origin_)};
  }

  Eigen::Vector2d origin_, along_;
  const LevelBorder& first_;
  const TableTopOptions& options_;
  Eigen::AlignedBox2d box_;
};

/// One side of a top, as its front.
struct Front {
  Eigen::Vector2d middle, away;  ///< away from the head, unit
  double width_m, depth_m;
};

/// The side that the head sees most squarely.
Front FrontOf(const Top& top, const Eigen::Vector2d& eye) {
  Front best{};
  double most = -2;
  const Eigen::Vector2d size = top.size_m();
  for (const bool along : {true, false}) {
    const double width = along ? size.x() : size.y(), depth = along ? size.y() : size.x();
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector2d away = sign * (along ? top.across() : top.along()),
                            middle = top.centre() - depth / 2 * away;
      const double square = away.dot((middle - eye).normalized());
      if (square <= most) continue;
      most = square;
      best = {middle, away, width, depth};
    }
  }
  return best;
}

class TopSearch {
 public:
  TopSearch(std::span<const LevelBorder> borders, std::span<const SceneObject> standing,
            const Eigen::Vector3d& eye, const TableTopOptions& options)
      : borders_(borders.begin(), borders.end()),
        known_(standing.begin(), standing.end()),
        n_standing_(known_.size()),
        eye_(eye),
        options_(options) {}

  std::vector<SceneObject> Run() {
    // The longest first: it says best how the top lies. Of two arrises of one border the upper one.
    std::stable_sort(borders_.begin(), borders_.end(), [](const LevelBorder& a, const LevelBorder& b) {
      return a.length_m() + a.height_m > b.length_m() + b.height_m;
    });
    std::vector<bool> used(borders_.size());
    for (std::size_t i = 0; i < borders_.size(); ++i) {
      if (used[i] || IsKnown(borders_[i])) continue;
      Top top(borders_[i], options_);
      Grow(top, used);
      known_.push_back(AsObject(top));
    }
    return {known_.begin() + static_cast<std::ptrdiff_t>(n_standing_), known_.end()};
  }

 private:
  void Grow(Top& top, std::vector<bool>& used) const {
    for (bool grew = true; std::exchange(grew, false);) {
      for (std::size_t i = 0; i < borders_.size(); ++i) {
        if (used[i] || !top.Has(borders_[i])) continue;
        top.Take(borders_[i]);
        used[i] = grew = true;
      }
    }
  }

  /// Whether a border lies on a thing that is known, or just below its top.
  bool IsKnown(const LevelBorder& border) const {
    return std::any_of(known_.begin(), known_.end(), [&](const SceneObject& thing) {
      if (thing.kind == ObjectKind::kEdge) return false;
      return border.height_m > thing.bottom_m - options_.under_m &&
             border.height_m < thing.top_m + options_.beside_m && Covers(thing, border.from) &&
             Covers(thing, border.to);
    });
  }

  bool Covers(const SceneObject& thing, const Eigen::Vector2d& at) const {
    const Eigen::Vector2d in_front = thing.base_from_front.Inverse() * at;
    const double beside = options_.beside_m;
    return in_front.x() > -beside && in_front.x() < thing.depth_m + beside &&
           std::abs(in_front.y()) < thing.width_m / 2 + beside;
  }

  SceneObject AsObject(const Top& top) const {
    const Eigen::Vector2d size = top.size_m();
    if (size.y() < options_.min_depth_m) return Border(top);
    const Front front = FrontOf(top, eye_.head<2>());
    SceneObject object = Hanging(front, top.first());
    object.kind = ObjectKind::kBox;
    object.depth_m = front.depth_m;
    return object;
  }

  SceneObject Border(const Top& top) const {
    Eigen::Vector2d away = top.across();
    if (away.dot(top.centre() - eye_.head<2>()) < 0) away = -away;
    return Hanging({top.centre(), away, top.size_m().x(), 0}, top.first());
  }

  /// Where it is depends on its height as the lines of sight do.
  SceneObject Hanging(const Front& front, const LevelBorder& border) const {
    SceneObject object;
    object.base_from_front = {front.middle.x(), front.middle.y(), std::atan2(front.away.y(), front.away.x())};
    const Eigen::Vector2d along(-front.away.y(), front.away.x()),
        by_height = (front.middle - eye_.head<2>()) / (border.height_m - eye_.z());
    const double frame = options_.frame_sigma_m, end = options_.end_sigma_m;
    object.covariance = frame * frame * Eigen::Matrix2d::Identity() + end * end * along * along.transpose() +
                        border.sigma_m * border.sigma_m * by_height * by_height.transpose();
    object.sigma_yaw_rad = options_.yaw_sigma_rad;
    object.width_m = front.width_m;
    object.top_m = border.height_m;
    object.bottom_m = border.height_m - options_.thickness_m;
    return object;
  }

  std::vector<LevelBorder> borders_;
  std::vector<SceneObject> known_;
  std::size_t n_standing_;
  Eigen::Vector3d eye_;
  const TableTopOptions& options_;
};

}  // namespace

std::vector<SceneObject> GroupBorders(std::span<const LevelBorder> borders,
                                      std::span<const SceneObject> standing, const Eigen::Vector3d& eye,
                                      const TableTopOptions& options) {
  return TopSearch(borders, standing, eye, options).Run();
}

}  // namespace priamos::head
