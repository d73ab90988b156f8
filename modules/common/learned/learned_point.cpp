#include "common/learned/learned_point.hpp"

#include <algorithm>

namespace priamos {

void LearnedPoint::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -200, 200, "map"});
  a.Number("y_m", y_m, {"m", -200, 200, "map"});
  a.Number("sigma_m", sigma_m, {"m", 0, 100, "standard deviation of the place"});
  a.Number("seen_s", seen_s, {"s", 0, 1e11, "since 1970, when it was heard last"});
}

void EnterPoint(const LearnedPoint& told, std::vector<LearnedPoint>& points) {
  constexpr double kOne_m = 0.2;
  const auto distance_m = [&](const LearnedPoint& point) { return (point.at() - told.at()).norm(); };
  const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return distance_m(a) < distance_m(b);
  });
  if (nearest != points.end() && distance_m(*nearest) <= kOne_m)
    *nearest = told;
  else
    points.push_back(told);
  if (points.size() <= kMostPoints) return;
  points.erase(std::min_element(points.begin(), points.end(),
                                [](const auto& a, const auto& b) { return a.seen_s < b.seen_s; }));
}

}  // namespace priamos
