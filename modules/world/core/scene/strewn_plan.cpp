#include "world/core/scene/strewn_plan.hpp"

#include "common/geometry.hpp"

namespace priamos::world {
namespace {

constexpr int kMost = 100;

ValueSpec Corner(std::string_view doc) {
  return {"m", -100, 100, doc};
}

}  // namespace

const std::vector<std::string>& StrewnKinds() {
  static const std::vector<std::string> kKinds{"carton", "cupboard", "bin",  "post",
                                               "table",  "board",    "glass"};
  return kKinds;
}

void FreeLane::Describe(Archive& a) {
  a.Numbers("from_m", from_m, Corner("map, one end of the middle line: x, y"));
  a.Numbers("to_m", to_m, Corner("map, the other end of the middle line: x, y"));
  a.Number("half_m", half_m, {"m", 0.1, 10, "half its width; it reaches as far beyond its ends"});
}

double FreeLane::DistanceTo(const Eigen::Vector2d& at) const {
  return DistanceToSegment({from_m[0], from_m[1]}, {to_m[0], to_m[1]}, at) - half_m;
}

void StrewnPlan::Describe(Archive& a) {
  std::vector<std::string> kinds{"any"};
  kinds.insert(kinds.end(), StrewnKinds().begin(), StrewnKinds().end());
  a.Choice("kind", kind, kinds, "what; board: 0.5 to 1.3 m above the floor; table: on four legs");
  a.Numbers("low_m", low_m, Corner("map, corner of the floor where they may stand: least x, y"));
  a.Numbers("high_m", high_m, Corner("map, the corner across: greatest x, y"));
  if (low_m[0] >= high_m[0] || low_m[1] >= high_m[1]) a.Refuse("high_m", "both beyond those of low_m");
  a.Integer("least", least, {"-", 0, kMost, "so many at least, where there is room"});
  a.Integer("most", most, {"-", 0, kMost, "so many at most, drawn from the seed"});
  if (most < least) a.Refuse("most", "at least as many as least");
}

}  // namespace priamos::world
