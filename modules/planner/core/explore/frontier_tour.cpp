#include "planner/core/explore/frontier_tour.hpp"

#include <algorithm>
#include <limits>

namespace priamos::planner {
namespace {

/// No way: it comes last, and does not make all orders alike.
constexpr double kFar_m = 1000;

double Length(double way_m) {
  return way_m < kFar_m ? way_m : kFar_m;
}

}  // namespace

std::size_t FirstOfTour(const std::vector<double>& to, const Eigen::MatrixXd& between) {
  const std::size_t n = to.size(), sets = std::size_t{1} << n;
  // rest[set][at]: from `at` over all places that are not in `set`, which holds it.
  std::vector<std::vector<double>> rest(sets, std::vector<double>(n, 0));
  for (std::size_t set = sets - 1; set-- > 1;)
    for (std::size_t at = 0; at < n; ++at) {
      if (!(set >> at & 1U)) continue;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t next = 0; next < n; ++next)
        if (!(set >> next & 1U))
          best = std::min(best, Length(between(Eigen::Index(at), Eigen::Index(next))) +
                                    rest[set | std::size_t{1} << next][next]);
      rest[set][at] = best;
    }
  std::size_t first = 0;
  const auto total = [&](std::size_t at) { return Length(to[at]) + rest[std::size_t{1} << at][at]; };
  for (std::size_t at = 1; at < n; ++at)
    if (total(at) < total(first) - 1e-9) first = at;
  return first;
}

}  // namespace priamos::planner
