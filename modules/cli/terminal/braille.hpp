#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace priamos::cli {

/// A picture of dots for a terminal: every character is a braille pattern of 2 x 4 dots. What is drawn with a
/// higher ink colours the whole character.
class Braille {
 public:
  /// Colour of a dot, from the lowest to the highest.
  enum Ink : std::uint8_t { kNone = 0, kDim, kRed, kGreen };

  /// Empty picture; its size is given in characters.
  Braille(int columns, int rows);

  int width() const { return 2 * columns_; }  ///< in dots
  int height() const { return 4 * rows_; }    ///< in dots
  /// Draws a line between two points (dots: x right, y down, (0, 0) the first), cut to the picture; every
  /// `pace`-th dot. Points that are not numbers draw nothing.
  void Line(double x0, double y0, double x1, double y1, Ink ink, int pace = 1);
  /// One line of text per row. `colour` adds the terminal's escape sequences.
  std::string Text(bool colour) const;

 private:
  std::size_t CellAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_, rows_;
  std::vector<std::uint8_t> dots_, inks_;
};

}  // namespace priamos::cli
