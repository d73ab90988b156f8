#include "head/core/doors/line_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace priamos::head {
namespace {

constexpr double kTurned = 0.04;  ///< a line may be so much turned against where it is expected [rad]
constexpr double kBridge_px = 8;  ///< gaps in a line that count as covered

struct Interval {
  double from, to;
  int line = -1;
};

/// Where `line` runs along `e`, if it lies on it.
std::optional<Interval> Along(const ViewLine& line, const ExpectedLine& e, double beside_px) {
  const Eigen::Vector2d a = line.p - e.p, b = line.q - e.p;
  const double s = e.direction.dot(a), t = e.direction.dot(b);
  const Interval piece{std::min(s, t), std::max(s, t)};
  if (piece.from > e.length_px || piece.to < 0) return std::nullopt;
  const double da = e.normal.dot(a), db = e.normal.dot(b);
  // Only what lies on the segment counts: a long line may go on beyond it.
  if (std::abs(db - da) > kTurned * (piece.to - piece.from) + 0.5) return std::nullopt;
  if (std::abs(da + db) / 2 > beside_px) return std::nullopt;
  return piece;
}

Cover Union(std::vector<Interval> pieces, double length_px) {
  if (pieces.empty()) return {};
  std::sort(pieces.begin(), pieces.end(),
            [](const Interval& a, const Interval& b) { return a.from < b.from; });
  double covered = 0, until = 0, longest = 0;
  Cover cover{0, pieces[0].from, pieces[0].to};
  for (const Interval& piece : pieces) {
    const double from = std::max(piece.from - until < kBridge_px ? until : piece.from, until);
    covered += std::max(0.0, std::min(piece.to, length_px) - from);
    until = std::max(until, std::min(piece.to, length_px));
    cover.last_px = std::max(cover.last_px, piece.to);
    if (piece.to - piece.from > longest) {
      longest = piece.to - piece.from;
      cover.line = piece.line;
    }
  }
  cover.share = covered / length_px;
  cover.last_px -= length_px;
  return cover;
}

/// What lines cover of `e`, by the sign of their contrast.
std::array<std::vector<Interval>, 2> Pieces(const CameraView& view, const ExpectedLine& e, double beside_px) {
  std::array<std::vector<Interval>, 2> pieces;
  for (std::size_t i = 0; i < view.lines.size(); ++i) {
    auto piece = Along(view.lines[i], e, beside_px);
    if (!piece) continue;
    piece->line = static_cast<int>(i);
    pieces[view.lines[i].normal.dot(e.normal) > 0].push_back(*piece);
  }
  return pieces;
}

}  // namespace

Cover CoverOf(const CameraView& view, const ExpectedLine& e, double beside_px) {
  auto pieces = Pieces(view, e, beside_px);
  const Cover a = Union(std::move(pieces[0]), e.length_px), b = Union(std::move(pieces[1]), e.length_px);
  return a.share > b.share ? a : b;
}

Cover CoverOfAnyContrast(const CameraView& view, const ExpectedLine& e, double beside_px) {
  auto pieces = Pieces(view, e, beside_px);
  pieces[0].insert(pieces[0].end(), pieces[1].begin(), pieces[1].end());
  return Union(std::move(pieces[0]), e.length_px);
}

}  // namespace priamos::head
