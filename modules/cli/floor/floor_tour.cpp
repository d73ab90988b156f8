#include "cli/floor/floor_tour.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <random>
#include <utility>

namespace priamos::cli {
namespace {

using Apart = std::vector<std::vector<double>>;
using Order = std::vector<int>;

/// Places are looked for on every fourth cell, until so much is seen.
constexpr int kEvery = 4, kRestarts = 20;
constexpr double kSeen = 0.98;
/// Less is no improvement.
constexpr double kLess_m = 1e-6;

struct Lookout {
  int cell = 0;
  std::vector<std::size_t> sees;  ///< of what can be reached
};

std::vector<Lookout> LookoutsOf(const TrueFloor& floor) {
  std::vector<Lookout> lookouts;
  for (int y = 0; y < floor.ny(); y += kEvery)
    for (int x = 0; x < floor.nx(); x += kEvery) {
      const int cell = y * floor.nx() + x;
      if (!floor.HasMiddle(std::size_t(cell))) continue;
      auto sees = floor.CellsSeenFrom(floor.PlaceOf(x, y));
      std::erase_if(sees, [&](std::size_t at) { return !floor.IsReachable(at); });
      std::sort(sees.begin(), sees.end());
      sees.erase(std::unique(sees.begin(), sees.end()), sees.end());
      lookouts.push_back({cell, std::move(sees)});
    }
  return lookouts;
}

/// The start, and then cells that see 98 % together, each the one that sees most of what is left.
std::vector<int> Cover(const TrueFloor& floor, int start) {
  std::vector<bool> open(floor.cells());
  std::size_t all = 0;
  for (std::size_t i = 0; i < open.size(); ++i) all += open[i] = floor.IsReachable(i);
  std::vector<int> cells{start};
  const std::vector<Lookout> lookouts = LookoutsOf(floor);
  for (std::size_t left = all; double(left) > (1 - kSeen) * double(all);) {
    const Lookout* best = nullptr;
    std::ptrdiff_t most = 0;
    for (const Lookout& lookout : lookouts) {
      const auto n =
          std::count_if(lookout.sees.begin(), lookout.sees.end(), [&](auto at) { return open[at]; });
      if (n > most) best = &lookout;
      most = std::max(most, n);
    }
    if (!best) break;
    for (const std::size_t at : best->sees) open[at] = false;
    left -= std::size_t(most);
    cells.push_back(best->cell);
  }
  return cells;
}

/// Ways of the base's middle from a cell to all others.
std::vector<float> WaysFrom(const TrueFloor& floor, int from) {
  using Open = std::pair<float, int>;
  std::vector<float> way_m(floor.cells(), std::numeric_limits<float>::infinity());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  way_m[std::size_t(from)] = 0;
  open.push({0.0F, from});
  while (!open.empty()) {
    const auto [at_m, at] = open.top();
    open.pop();
    if (at_m > way_m[std::size_t(at)]) continue;
    const int x = at % floor.nx(), y = at / floor.nx();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= floor.nx() || y + dy >= floor.ny()) continue;
        const int next = (y + dy) * floor.nx() + x + dx;
        const auto total_m = at_m + static_cast<float>(TrueFloor::kStep_m * std::hypot(dx, dy));
        if (!floor.HasMiddle(std::size_t(next)) || total_m >= way_m[std::size_t(next)]) continue;
        way_m[std::size_t(next)] = total_m;
        open.push({total_m, next});
      }
  }
  return way_m;
}

Order NearestNeighbours(const Apart& apart_m) {
  Order order{0}, left(apart_m.size() - 1);
  std::iota(left.begin(), left.end(), 1);
  while (!left.empty()) {
    const auto& from = apart_m[std::size_t(order.back())];
    const auto next = std::min_element(
        left.begin(), left.end(), [&](int a, int b) { return from[std::size_t(a)] < from[std::size_t(b)]; });
    order.push_back(*next);
    left.erase(next);
  }
  return order;
}

double Between(const Order& order, const Apart& apart_m, std::size_t i, std::size_t k) {
  return k >= order.size() ? 0 : apart_m[std::size_t(order[i])][std::size_t(order[k])];
}

/// A piece the other way round (2-opt). True when it became shorter.
bool Turned(Order& order, const Apart& apart_m) {
  for (std::size_t i = 1; i + 1 < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const double now_m = Between(order, apart_m, i - 1, i) + Between(order, apart_m, k, k + 1);
      const double then_m = Between(order, apart_m, i - 1, k) + Between(order, apart_m, i, k + 1);
      if (then_m >= now_m - kLess_m) continue;
      std::reverse(order.begin() + std::ptrdiff_t(i), order.begin() + std::ptrdiff_t(k) + 1);
      return true;
    }
  return false;
}

/// One to three places elsewhere (Or-opt). True when it became shorter.
bool Shifted(Order& order, const Apart& apart_m) {
  const double now_m = LengthOf(order, apart_m);
  for (std::ptrdiff_t n = 1; n <= 3; ++n)
    for (std::ptrdiff_t from = 1; from + n <= std::ptrdiff_t(order.size()); ++from) {
      Order rest = order;
      rest.erase(rest.begin() + from, rest.begin() + from + n);
      for (std::ptrdiff_t to = 1; to <= std::ptrdiff_t(rest.size()); ++to) {
        const auto at = std::size_t(to);
        const int first = order[std::size_t(from)], last = order[std::size_t(from + n - 1)];
        const auto way_m = [&](int a, int b) { return apart_m[std::size_t(a)][std::size_t(b)]; };
        double more_m = way_m(rest[at - 1], first);
        if (at < rest.size()) more_m += way_m(last, rest[at]) - way_m(rest[at - 1], rest[at]);
        double less_m = way_m(order[std::size_t(from - 1)], first);
        if (std::size_t(from + n) < order.size())
          less_m += way_m(last, order[std::size_t(from + n)]) -
                    way_m(order[std::size_t(from - 1)], order[std::size_t(from + n)]);
        if (more_m >= less_m - kLess_m) continue;
        rest.insert(rest.begin() + to, order.begin() + from, order.begin() + from + n);
        order = std::move(rest);
        return LengthOf(order, apart_m) < now_m;
      }
    }
  return false;
}

Order Improved(Order order, const Apart& apart_m) {
  while (Turned(order, apart_m) || Shifted(order, apart_m)) {
  }
  return order;
}

}  // namespace

double LengthOf(const std::vector<int>& order, const Apart& apart_m) {
  double length_m = 0;
  for (std::size_t i = 1; i < order.size(); ++i) length_m += Between(order, apart_m, i - 1, i);
  return length_m;
}

std::vector<int> ShortestOrder(const Apart& apart_m, int restarts) {
  Order best = Improved(NearestNeighbours(apart_m), apart_m);
  std::mt19937 random(1);
  for (int i = 0; i < restarts; ++i) {
    Order order = best;
    std::shuffle(order.begin() + 1, order.end(), random);
    order = Improved(std::move(order), apart_m);
    if (LengthOf(order, apart_m) < LengthOf(best, apart_m)) best = std::move(order);
  }
  return best;
}

FloorTour TourOf(const TrueFloor& floor, const Eigen::Vector2d& start) {
  const int begin = floor.IndexAt(start);
  if (begin < 0) return {};
  const std::vector<int> cells = Cover(floor, begin);
  Apart apart_m;
  for (const int from : cells) {
    const std::vector<float> way_m = WaysFrom(floor, from);
    apart_m.emplace_back();
    for (const int to : cells) apart_m.back().push_back(way_m[std::size_t(to)]);
  }
  return {LengthOf(ShortestOrder(apart_m, kRestarts), apart_m), static_cast<int>(cells.size()) - 1};
}

}  // namespace priamos::cli
