#include "common/drawing/label_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace priamos::drawing {
namespace {

constexpr int kDirections = 16;
/// A covered point of a line is as bad as so many pixels of distance.
constexpr double kCost_px = 15;

/// The label whose border is `distance` away from the point, in one of the directions.
Box Beside(const LabelWish& wish, double distance, int direction) {
  const double angle = 2 * std::numbers::pi * direction / kDirections;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  // Corners would stand farther off than sides: each axis moves by what the label needs there.
  const double x = wish.at.x() + cosine * distance + std::clamp(1.5 * cosine, -1.0, 1.0) * wish.width / 2;
  const double y = wish.at.y() - sine * distance - std::clamp(1.5 * sine, -1.0, 1.0) * wish.height / 2;
  return {x - wish.width / 2, y - wish.height / 2, wish.width, wish.height};
}

class Placer {
 public:
  explicit Placer(const Surroundings& around) : around_(around), taken_(around.taken) {}

  std::optional<Box> Place(const LabelWish& wish) {
    best_cost_ = std::numeric_limits<double>::infinity();
    best_.reset();
    if (wish.centred)
      Try({wish.at.x() - wish.width / 2, wish.at.y() - wish.height / 2, wish.width, wish.height}, 0);
    const double step = std::max(wish.height / 2, 2.0);
    const double farthest = std::hypot(around_.page.width, around_.page.height);
    for (double d = wish.distance; d <= farthest && d - wish.distance < best_cost_; d += step)
      for (int k = 0; k < kDirections; ++k) Try(Beside(wish, d, k), d - wish.distance);
    if (best_) taken_.push_back(*best_);
    return best_;
  }

 private:
  void Try(const Box& box, double distance) {
    if (distance >= best_cost_ || !around_.page.Holds(box)) return;
    if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& t) { return t.Overlaps(box); })) return;
    const auto covered = std::count_if(around_.lines.begin(), around_.lines.end(),
                                       [&](const auto& p) { return box.Holds(p); });
    const double cost = distance + kCost_px * static_cast<double>(covered);
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_ = box;
  }

  const Surroundings& around_;
  std::vector<Box> taken_;
  std::optional<Box> best_;
  double best_cost_ = 0;
};

}  // namespace

std::vector<std::optional<Box>> PlaceLabels(const std::vector<LabelWish>& wishes,
                                            const Surroundings& around) {
  Placer placer(around);
  std::vector<std::optional<Box>> places;
  places.reserve(wishes.size());
  for (const LabelWish& wish : wishes)
    places.push_back(wish.at.allFinite() ? placer.Place(wish) : std::nullopt);
  return places;
}

}  // namespace priamos::drawing
