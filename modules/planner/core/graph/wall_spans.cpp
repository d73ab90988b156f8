#include "planner/core/graph/wall_spans.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::planner {
namespace {

using Group = std::vector<WallSpan>;

/// Heard within this time it was one drive along the wall; then a smaller gap than this is none.
constexpr double kOneDrive_s = 60, kBridged_m = 0.3;
/// So much, or half of the shorter one, two drives have to have in common.
constexpr double kInCommon_m = 0.6;
/// Ends that lie so near to each other are one; a piece that ends earlier was left earlier.
constexpr double kOneEnd_m = 0.8;

bool AreOne(const WallSpan& a, const WallSpan& b) {
  const double common_m = std::min(a.to_m, b.to_m) - std::max(a.from_m, b.from_m);
  if (std::abs(a.wall.seen_s - b.wall.seen_s) <= kOneDrive_s) return common_m >= -kBridged_m;
  return common_m >= std::min({kInCommon_m, (a.to_m - a.from_m) / 2, (b.to_m - b.from_m) / 2});
}

bool IsOneOf(const WallSpan& piece, const Group& group) {
  return std::any_of(group.begin(), group.end(), [&](const WallSpan& other) { return AreOne(piece, other); });
}

std::vector<Group> Grouped(const std::vector<WallSpan>& pieces) {
  std::vector<Group> groups;
  for (const WallSpan& piece : pieces) {
    Group own{piece};
    const auto others = std::stable_partition(
        groups.begin(), groups.end(), [&](const Group& group) { return !IsOneOf(own.front(), group); });
    for (auto group = others; group != groups.end(); ++group)
      own.insert(own.end(), group->begin(), group->end());
    groups.erase(others, groups.end());
    groups.push_back(std::move(own));
  }
  return groups;
}

WallSpan SpanOf(const Group& group) {
  const auto is_older = [](const WallSpan& a, const WallSpan& b) { return a.wall.seen_s < b.wall.seen_s; };
  WallSpan span = *std::max_element(group.begin(), group.end(), is_older);
  double first_m = span.from_m, last_m = span.to_m;
  for (const WallSpan& piece : group) {
    first_m = std::min(first_m, piece.from_m);
    last_m = std::max(last_m, piece.to_m);
  }
  double first_s = -INFINITY, last_s = -INFINITY;
  for (const WallSpan& piece : group) {
    const double seen_s = piece.wall.seen_s;
    if (piece.from_m <= first_m + kOneEnd_m && seen_s > first_s) span.from_m = piece.from_m, first_s = seen_s;
    if (piece.to_m >= last_m - kOneEnd_m && seen_s > last_s) span.to_m = piece.to_m, last_s = seen_s;
  }
  return span;
}

}  // namespace

std::vector<WallSpan> JoinedSpans(const std::vector<WallSpan>& pieces) {
  std::vector<WallSpan> spans;
  for (const Group& group : Grouped(pieces)) spans.push_back(SpanOf(group));
  std::sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) { return a.from_m < b.from_m; });
  return spans;
}

}  // namespace priamos::planner
