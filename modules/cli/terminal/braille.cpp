#include "cli/terminal/braille.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace priamos::cli {
namespace {

/// Bit of the dot at (x, y) in U+2800: the first six go down the columns, the lowest row came later.
constexpr std::uint8_t kBits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
constexpr std::array<const char*, 4> kColours{"", "\x1b[2m", "\x1b[31m", "\x1b[1;32m"};
constexpr const char* kPlain = "\x1b[0m";

std::string Utf8(std::uint8_t dots) {
  return {static_cast<char>(0xe2), static_cast<char>(0xa0 | dots >> 6),
          static_cast<char>(0x80 | (dots & 63))};
}

/// Narrows [from, to] to the shares for which low <= at + share * delta <= high; false if nothing is left.
bool Clip(double at, double delta, double low, double high, double& from, double& to) {
  if (delta == 0) return at >= low && at <= high;
  double enter = (low - at) / delta, leave = (high - at) / delta;
  if (enter > leave) std::swap(enter, leave);
  from = std::max(from, enter);
  to = std::min(to, leave);
  return from <= to;
}

}  // namespace

Braille::Braille(int columns, int rows)
    : columns_(std::max(columns, 1)),
      rows_(std::max(rows, 1)),
      dots_(static_cast<std::size_t>(columns_) * rows_),
      inks_(dots_.size()) {}

void Braille::Line(double x0, double y0, double x1, double y1, Ink ink, int pace) {
  if (!std::isfinite(x0 + y0 + x1 + y1)) return;
  double from = 0, to = 1;
  if (!Clip(x0, x1 - x0, 0, width() - 1, from, to) || !Clip(y0, y1 - y0, 0, height() - 1, from, to)) return;
  const double wx = x1 - x0, wy = y1 - y0;
  x1 = x0 + to * wx;
  y1 = y0 + to * wy;
  x0 += from * wx;
  y0 += from * wy;
  const int steps = static_cast<int>(std::ceil(std::max(std::abs(x1 - x0), std::abs(y1 - y0))));
  for (int i = 0; i <= steps; i += std::max(pace, 1)) {
    const double share = steps == 0 ? 0 : static_cast<double>(i) / steps;
    const auto x = std::clamp(static_cast<int>(std::lround(x0 + share * (x1 - x0))), 0, width() - 1);
    const auto y = std::clamp(static_cast<int>(std::lround(y0 + share * (y1 - y0))), 0, height() - 1);
    const auto cell = CellAt(x / 2, y / 4);
    dots_[cell] |= kBits[y % 4][x % 2];
    inks_[cell] = std::max<std::uint8_t>(inks_[cell], ink);
  }
}

std::string Braille::Text(bool colour) const {
  std::string text;
  for (int row = 0; row < rows_; ++row) {
    std::uint8_t ink = kNone;
    for (int column = 0; column < columns_; ++column) {
      const auto cell = CellAt(column, row);
      if (colour && inks_[cell] != ink) {
        text += kPlain;
        text += kColours[ink = inks_[cell]];
      }
      text += Utf8(dots_[cell]);
    }
    if (ink != kNone) text += kPlain;
    text += '\n';
  }
  return text;
}

}  // namespace priamos::cli
