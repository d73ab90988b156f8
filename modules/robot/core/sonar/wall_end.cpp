#include "robot/core/sonar/wall_end.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/geometry.hpp"

namespace priamos::robot {
namespace {

constexpr double kHalfBeam = Radians(7.5);
/// The last echoes that are looked at, and how far beyond the end a beam hears it at most.
constexpr double kWindow_m = 1.2, kMostBeyond_m = 0.5, kStep_m = 0.02;
/// So many echoes before the end tell where the line is there.
constexpr int kLeastBefore = 5;
/// A bend that makes the squares of the residuals smaller by so much, in sigmas of a range, is one.
constexpr double kLeastGain = 9;
constexpr double kBendSigma_m = 0.04, kLeastSigma_m = 0.03;

/// Sum of the squares of the residuals for a wall that ends there; what all of them have in common is an
/// error of the line. nullopt: too few echoes before the end.
std::optional<double> SquaresOf(std::span<const EchoBeside> echoes, double first_m, double end_m) {
  int count = 0, before = 0;
  double sum = 0, squares = 0;
  for (const EchoBeside& echo : echoes) {
    if (echo.along_m < first_m) continue;
    const double beyond_m = std::max(0.0, echo.along_m - end_m);
    const double residual = echo.range_m - std::hypot(echo.line_m, beyond_m);
    before += beyond_m == 0 ? 1 : 0;
    ++count;
    sum += residual;
    squares += residual * residual;
  }
  if (before < kLeastBefore) return std::nullopt;
  return squares - sum * sum / count;
}

}  // namespace

WallEnd FindWallEnd(std::span<const EchoBeside> echoes, const WallFitConfig& noise) {
  const EchoBeside& last = *std::max_element(
      echoes.begin(), echoes.end(), [](const auto& a, const auto& b) { return a.along_m < b.along_m; });
  const double first_m = last.along_m - kWindow_m;
  const WallEnd heard{last.along_m, kLeastSigma_m + last.range_m * std::tan(kHalfBeam) / std::sqrt(3)};
  const auto straight = SquaresOf(echoes, first_m, last.along_m);
  if (!straight) return heard;
  WallEnd bent = heard;
  double least = *straight;
  for (double beyond_m = kStep_m; beyond_m <= kMostBeyond_m; beyond_m += kStep_m) {
    const auto squares = SquaresOf(echoes, first_m, last.along_m - beyond_m);
    if (!squares || *squares >= least) continue;
    least = *squares;
    bent = {last.along_m - beyond_m, kBendSigma_m};
  }
  return *straight - least > kLeastGain * std::pow(noise.SigmaOf(last.range_m), 2) ? bent : heard;
}

}  // namespace priamos::robot
