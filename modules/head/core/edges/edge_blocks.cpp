#include "head/core/edges/edge_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

void EdgeBlocks::ChooseSize(int n_rows) {
  block_rows_ = n_rows < 24 ? 3 : n_rows < 160 ? 4 : 8 + n_rows / int(kMaxBlocks / 2);
}

void EdgeBlocks::Measure(const AxisLine& line, int first, int last) {
  blocks_.clear();
  total_ = EdgeSums{};
  for (int t = first; t <= last && blocks_.size() < kMaxBlocks; t += block_rows_) {
    blocks_.push_back(profile_.Sum(line, t, std::min(t + block_rows_ - 1, last)));
    total_.Add(blocks_.back());
  }
  mean_strength_ = total_.strength / total_.rows;
  farthest_ = float(kMaxShift_px) * total_.sharpness[0] / total_.strength;
}

bool EdgeBlocks::IsEdge(const EdgeSums& b) const {
  return b.rows > 0 && b.strength > 0.5F * mean_strength_ * b.rows &&
         std::abs(b.imbalance[0]) < farthest_ * b.strength;
}

bool EdgeBlocks::FindEnds(const AxisLine& line) {
  Extend(line);
  Trim();
  return !blocks_.empty();
}

void EdgeBlocks::Extend(const AxisLine& line) {
  const int extent = profile_.Extent(line);
  const auto ahead = [&](const EdgeSums& last, int step) {
    const float at = last.along + 0.5F * float(step) * (last.rows + 1);  // a whole number
    if (at < 0) return EdgeSums{};
    const int next = static_cast<int>(std::lround(at)), far = next + step * (block_rows_ - 1);
    return next < extent ? profile_.Sum(line, std::min(next, far), std::max(next, far)) : EdgeSums{};
  };
  const auto room = [&] { return blocks_.size() + front_.size() < kMaxBlocks; };
  front_.clear();
  while (room() && IsEdge(blocks_.back())) blocks_.push_back(ahead(blocks_.back(), 1));
  EdgeSums first = blocks_.front();
  while (room() && IsEdge(first)) front_.push_back(first = ahead(first, -1));
  blocks_.insert(blocks_.begin(), front_.rbegin(), front_.rend());
}

void EdgeBlocks::Trim() {
  EdgeSums before, after;  // the blocks just beyond the ends
  while (!blocks_.empty() && !IsEdge(blocks_.back())) {
    after = blocks_.back();
    blocks_.pop_back();
  }
  std::size_t lost = 0;
  while (lost < blocks_.size() && !IsEdge(blocks_[lost])) before = blocks_[lost++];
  blocks_.erase(blocks_.begin(), blocks_.begin() + lost);
  total_ = EdgeSums{};
  for (const EdgeSums& b : blocks_) total_.Add(b);
  if (blocks_.empty()) return;
  const EdgeSums &front = blocks_.front(), &back = blocks_.back();
  const float mean = MeanInside();
  // Rows of the edge inside a block at its end.
  const auto part = [&](const EdgeSums& b) { return std::clamp(b.strength / mean, 0.0F, b.rows); };
  first_ = front.along + 0.5F * front.rows - part(front) - part(before);
  last_ = back.along - 0.5F * back.rows + part(back) + part(after);
}

/// Strength of a row of an edge whose outermost blocks it may fill only in part.
float EdgeBlocks::MeanInside() const {
  const EdgeSums &front = blocks_.front(), &back = blocks_.back();
  const float rows = total_.rows - front.rows - back.rows;
  return rows > 0 ? (total_.strength - front.strength - back.strength) / rows : mean_strength_;
}

}  // namespace priamos::head
