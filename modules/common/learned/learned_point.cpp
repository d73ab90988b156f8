#include "common/learned/learned_point.hpp"

#include <algorithm>

#include "common/learned/required_place.hpp"

namespace priamos {

void LearnedPoint::Describe(Archive& a) {
  a.Integer("id", id, {"-", 1, 1e9, "number of the point"});
  a.Number("x_m", x_m, {"m", -200, 200, "map"});
  a.Number("y_m", y_m, {"m", -200, 200, "map"});
  a.Number("sigma_m", sigma_m, {"m", 0, 100, "standard deviation of the place"});
  a.Number("seen_s", seen_s, {"s", 0, 1e11, "since 1970, when it was heard last"});
  RequirePlace(a, "the number of the point");
  a.Require("sigma_m", "how well its place is known");
}

int EnterPoint(const LearnedPoint& told, std::vector<LearnedPoint>& points) {
  const auto distance_m = [&](const LearnedPoint& point) { return (point.at() - told.at()).norm(); };
  const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return distance_m(a) < distance_m(b);
  });
  LearnedPoint entered = told;
  if (nearest != points.end() && distance_m(*nearest) <= kSamePoint_m) {
    entered.id = nearest->id;
    *nearest = entered;
    return entered.id;
  }
  entered.id = 1;
  for (const LearnedPoint& point : points) entered.id = std::max(entered.id, point.id + 1);
  points.push_back(entered);
  if (points.size() > kMostPoints)
    points.erase(std::min_element(points.begin(), points.end(),
                                  [](const auto& a, const auto& b) { return a.seen_s < b.seen_s; }));
  return entered.id;
}

}  // namespace priamos
