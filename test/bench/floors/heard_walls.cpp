#include "test/bench/floors/heard_walls.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::bench {
namespace {

using Eigen::Vector2d;

constexpr double kCell_m = 0.1, kHears_m = 2.5, kHeight_m = 0.4;
/// A wall has so many cells at least and at most, may miss so many in between, and is told anew when so many
/// came.
constexpr int kLeast = 8, kMost = 40, kGap = 3, kGrown = 10;
/// Nothing more comes after so many metres.
constexpr double kEnded_m = 0.9, kBetween_m = 1.2;

}  // namespace

HeardWalls::HeardWalls(const cli::TrueWorld& world, const cli::TrueFloor& floor, std::uint64_t seed)
    : floor_(floor), solid_(floor.cells(), false), rng_(Rng::Stream(seed, "heard walls")) {
  for (const Rectangle& outline : cli::OutlinesAt(world, kHeight_m, kHeight_m)) {
    for (int y = 0; y < floor.ny(); ++y)
      for (int x = 0; x < floor.nx(); ++x)
        if (Distance(outline, floor.PlaceOf(x, y)) <= 0.02)
          solid_[std::size_t(y) * std::size_t(floor.nx()) + std::size_t(x)] = true;
    const auto corners = outline.Corners();
    for (std::size_t i = 0; i < 4; ++i) {
      Vector2d a = corners[i], b = corners[(i + 1) % 4];
      const Vector2d middle = (a + b) / 2 - outline.map_from_centre.translation();
      Vector2d left(-(b - a).y(), (b - a).x());
      if (left.dot(middle) < 0) std::swap(a, b);  // the floor is to the left
      const Vector2d along = (b - a).normalized();
      if ((b - a).norm() < 0.3) continue;
      const auto cells = static_cast<std::size_t>((b - a).norm() / kCell_m);
      faces_.push_back({a, along, {-along.y(), along.x()}, (b - a).norm(), std::vector<double>(cells, -1)});
    }
  }
}

void HeardWalls::HearFrom(const Vector2d& at, double driven_m) {
  for (Face& face : faces_) {
    Hear(face, at, driven_m);
    HearEnds(face, at);
  }
  if (driven_m < next_m_) return;
  auto due = DueAfter(driven_m);
  if (due.empty()) return;
  std::stable_sort(due.begin(), due.end(), [](const Due& a, const Due& b) { return a.grown > b.grown; });
  for (std::size_t i = 0; i < std::min<std::size_t>(2, due.size()); ++i) Tell(due[i]);
  next_m_ = driven_m + kBetween_m;
  ++revision_;
}

void HeardWalls::Hear(Face& face, const Vector2d& at, double driven_m) const {
  const double y = face.out.dot(at - face.from), x = face.along.dot(at - face.from);
  if (y < 0 || y > kHears_m || x < -kCell_m || x > face.length_m + kCell_m) return;
  const Vector2d foot = face.from + std::clamp(x, 0.0, face.length_m) * face.along + 0.08 * face.out;
  if (IsHidden(at, foot)) return;
  const double half_m = 0.1 + 0.04 * y;
  const int first = std::max(0, static_cast<int>((x - half_m) / kCell_m));
  const int end =
      std::min(static_cast<int>(face.heard_m.size()), static_cast<int>((x + half_m) / kCell_m) + 1);
  for (int i = first; i < end; ++i) face.heard_m[std::size_t(i)] = driven_m;
}

/// The corner of two faces is heard once.
void HeardWalls::HearEnds(const Face& face, const Vector2d& at) {
  constexpr double kHearsEdge_m = 2, kBefore_m = 0.08;
  for (const Vector2d& end : {face.from, Vector2d(face.from + face.length_m * face.along)})
    if ((end - at).norm() <= kHearsEdge_m && face.out.dot(at - end) > 0 &&
        !IsHidden(at, end + kBefore_m * face.out))
      EnterPoint({end.x(), end.y(), 0.02, 0}, points_);
}

bool HeardWalls::IsHidden(const Vector2d& from, const Vector2d& to) const {
  for (double part = 0.05; part < 0.95; part += 0.05)
    if (IsSolid(from + part * (to - from))) return true;
  return false;
}

bool HeardWalls::IsSolid(const Vector2d& at) const {
  const int cell = floor_.IndexAt(at);
  return cell < 0 || solid_[std::size_t(cell)];
}

/// Runs of cells that were heard, cut into walls.
std::vector<HeardWalls::Due> HeardWalls::DueAfter(double driven_m) const {
  std::vector<Due> due;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    const auto& heard = faces_[k].heard_m;
    const int n = static_cast<int>(heard.size());
    for (int i = 0; i < n; ++i) {
      if (heard[std::size_t(i)] < 0) continue;
      int last = i;
      for (int j = i; j < n && j - last <= kGap; ++j)
        if (heard[std::size_t(j)] >= 0) last = j;
      for (int first = i; first + kLeast - 1 <= last; first += kMost)
        AddDue(k, first, std::min(last, first + kMost - 1), driven_m, due);
      i = last;
    }
  }
  return due;
}

void HeardWalls::AddDue(std::size_t face, int first, int last, double driven_m, std::vector<Due>& due) const {
  const auto& heard = faces_[face].heard_m;
  const double newest_m = *std::max_element(heard.begin() + first, heard.begin() + last + 1);
  const auto known = ids_.find({face, first});
  const int grown = last - first + 1 - (known == ids_.end() ? 0 : cells_told_[known->second]);
  const bool ended = driven_m - newest_m > kEnded_m || last - first + 1 == kMost;
  if (grown >= kGrown || (grown > 0 && ended)) due.push_back({face, first, last, grown});
}

void HeardWalls::Tell(const Due& due) {
  const Face& face = faces_[due.face];
  const double from_m = kCell_m * due.first - rng_.Uniform(-0.05, 0.2),
               to_m = kCell_m * (due.last + 1) + rng_.Uniform(-0.05, 0.2);
  const Vector2d middle = face.from + (from_m + to_m) / 2 * face.along + rng_.Uniform(-0.03, 0.03) * face.out;
  const auto [at, is_new] = ids_.try_emplace({due.face, due.first}, told_.size());
  if (is_new) told_.emplace_back(), cells_told_.push_back(0);
  LearnedWall& wall = told_[at->second];
  wall.id = static_cast<int>(at->second) + 1;
  wall.x_m = middle.x();
  wall.y_m = middle.y();
  wall.yaw_deg = Degrees(std::atan2(face.along.y(), face.along.x()));
  wall.length_m = to_m - from_m;
  wall.sigma_across_m = 0.03;
  wall.sigma_yaw_deg = 0.5;
  wall.sigma_end_m = 0.1;
  cells_told_[at->second] = due.last - due.first + 1;
}

}  // namespace priamos::bench
