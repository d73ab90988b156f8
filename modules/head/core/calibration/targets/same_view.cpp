#include "head/core/calibration/targets/same_view.hpp"

#include <algorithm>

namespace priamos::head {

bool ShowSameView(const std::vector<DiscObservation>& a, const std::vector<DiscObservation>& b) {
  if (a.size() != b.size()) return false;
  return std::ranges::all_of(a, [&](const DiscObservation& of_a) {
    return std::ranges::any_of(b, [&](const DiscObservation& of_b) {
      return (of_a.centroid_px - of_b.centroid_px).norm() < kSameView_px;
    });
  });
}

}  // namespace priamos::head
