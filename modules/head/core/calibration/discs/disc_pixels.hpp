#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/calibration/discs/disc_window.hpp"

namespace priamos::head {

/// Normal equations of the two groups of parameters of a DiscModel.
struct NormalEquations {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Vector = Eigen::Matrix<double, 6, 1>;
  Matrix odd = Matrix::Zero(), even = Matrix::Zero();
  Vector odd_rhs = Vector::Zero(), even_rhs = Vector::Zero();
  double squares = 0;
  int pixels = 0;
};

/// Sums over the pixels on which only brightness and background act: all inside the rim or all outside.
struct FlatPixels {
  double n = 0, r = 0, rx = 0, ry = 0, xx = 0, xy = 0, yy = 0, squares = 0;

  void Add(double dx, double dy, double residual) {
    n += 1;
    r += residual;
    rx += residual * dx;
    ry += residual * dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    squares += residual * residual;
  }
  /// Adds the pixels to the normal equations; `amplitude` is that of the model inside the rim, 0 outside.
  void AddTo(NormalEquations& eq, double amplitude) const;
};

/// Sums of grey values, which no model changes: taken once for the pixels deep inside the disc.
struct GreySums {
  double n = 0, g = 0, gg = 0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero(), gx = Eigen::Vector2d::Zero();
  Eigen::Matrix2d xx = Eigen::Matrix2d::Zero();

  /// Pixels of one row, from u0 to u1, with coordinates from (origin_u, origin_v).
  void AddRow(const std::uint8_t* row, int u0, int u1, double origin_u, double dy);
  /// The residuals against level + slope * (x + shift).
  FlatPixels Against(double level, const Eigen::Vector2d& slope, const Eigen::Vector2d& shift) const;
};

/// The pixels of a window: those within `margin_px` of the rim or outside one by one, the core as sums.
struct WindowPixels {
  /// Place [px] and grey value of one pixel.
  struct Pixel {
    float dx, dy, grey;  ///< from the centre of the window
  };
  std::vector<Pixel> shell;
  GreySums core;
  double margin_px = 0;

  void Collect(const GreyImage& image, const Ellipse& disc, const Ellipse& window,
               std::span<const Ellipse> others, double margin);
};

}  // namespace priamos::head
