#include "head/core/floor/laser_stripe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr int kTaps = 6;  // of the smoothing filter, on either side
constexpr int kPhases = 64;
constexpr double kSmoothing_px = 1.5;
constexpr int kSlab_px = 32;  // rows of which the strongest ridge is kept, where several are wanted
constexpr int kSide = 3;      // rows that give the ground on either side
constexpr int kSteps = 5;
constexpr double kSystematic_px = 0.006;  // what phases and pixels leave, however little noise there is

/// First and second derivative of a Gaussian, at every row, for every sub-pixel phase of its centre.
struct RidgeKernel {
  std::array<std::array<float, 2 * kTaps + 1>, kPhases + 1> first{}, second{};

  RidgeKernel() {
    constexpr double kVariance = kSmoothing_px * kSmoothing_px;
    for (int phase = 0; phase <= kPhases; ++phase) {
      for (int i = -kTaps; i <= kTaps; ++i) {
        const double x = i - (static_cast<double>(phase) / kPhases - 0.5);
        const double g = std::exp(-x * x / (2 * kVariance));
        first[phase][i + kTaps] = static_cast<float>(x / kVariance * g);
        second[phase][i + kTaps] = static_cast<float>((x * x / kVariance - 1) / kVariance * g);
      }
    }
  }
};

const RidgeKernel& Kernel() {
  static const RidgeKernel kKernel;
  return kKernel;
}

/// The grey values of one column around a row.
class Column {
 public:
  Column(const GreyImage& image, int u) : first_(image.pixels.data() + u), width_(image.width) {}
  int operator[](int v) const { return first_[static_cast<std::size_t>(v) * width_]; }

 private:
  const std::uint8_t* first_;
  int width_;
};

/// Straight line through what lies above and below of the ridge.
struct Ground {
  double level, slope;  ///< at the row asked for, and per row
  double brighter;      ///< of both sides
  double roughness;     ///< mean square of the change from row to row

  Ground(const Column& column, int v, int reach) {
    double above = 0, below = 0, rough = 0;
    for (int i = 0; i < kSide; ++i) {
      above += column[v - reach - i];
      below += column[v + reach + i];
    }
    for (int i = 1; i < kSide; ++i) {
      const double a = column[v - reach - i] - column[v - reach - i + 1];
      const double b = column[v + reach + i] - column[v + reach + i - 1];
      rough += a * a + b * b;
    }
    level = (above + below) / (2 * kSide);
    brighter = std::max(above, below) / kSide;
    slope = (below - above) / kSide / (2 * reach + kSide - 1);
    roughness = rough / (2 * (kSide - 1));
  }
};

/// The brightest of the rows first to last.
int BrightestRow(const Column& column, int first, int last) {
  int best = first, most = -1;
  for (int v = first; v <= last; ++v) {
    const int sum = column[v - 1] + 2 * column[v] + column[v + 1];
    if (sum > most) {
      most = sum;
      best = v;
    }
  }
  return best;
}

struct Ridge {
  double v, contrast, least_contrast, roughness;
  double gain;  ///< displacement of the ridge by noise of a pixel [px per grey level]
};

/// Correlation of a column, its ground taken off, with the derivatives of a Gaussian at row + shift.
struct Slopes {
  double first = 0, second = 0;

  Slopes(const Column& column, const Ground& ground, int row, int phase) {
    const auto &k1 = Kernel().first[phase], &k2 = Kernel().second[phase];
    float sum1 = 0, sum2 = 0;
    const auto level = static_cast<float>(ground.level), slope = static_cast<float>(ground.slope);
    for (int i = -kTaps; i <= kTaps; ++i) {
      const float value = static_cast<float>(column[row + i]) - level - slope * static_cast<float>(i);
      sum1 += k1[i + kTaps] * value;
      sum2 += k2[i + kTaps] * value;
    }
    first = sum1;
    second = sum2;
  }
};

/// Newton's method on the derivative of the smoothed column, from `row`, which must lie within first and
/// last, as the result must. nullopt where there is no maximum close by.
std::optional<Ridge> Refine(const Column& column, int row, int first, int last, int reach) {
  // Norm of the first derivative of the Gaussian.
  static const double kNorm = std::sqrt(std::sqrt(kPi) / (2 * kSmoothing_px));
  double shift = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Ground ground(column, row, reach);
    const int phase = static_cast<int>(std::lround((shift + 0.5) * kPhases));
    const double at = static_cast<double>(phase) / kPhases - 0.5;
    const Slopes slopes(column, ground, row, phase);
    const double next = at - slopes.first / slopes.second;
    if (!(slopes.second < 0) || !(std::abs(next) < 1.5)) return std::nullopt;
    const int whole = static_cast<int>(std::lround(next));  // the brightest row need not be the right one
    const bool settled = std::abs(next - at) < 1.0 / kPhases;
    shift = std::clamp(next - whole, -0.5, 0.5);
    row += whole;
    if (row < first || row > last) return std::nullopt;
    if (settled)
      return Ridge{row + shift, column[row] - ground.level, column[row] - ground.brighter, ground.roughness,
                   kNorm / -slopes.second};
  }
  return std::nullopt;
}

/// A row of the image, the ones beside it, and those at the reach of a line.
struct RowsAround {
  const std::uint8_t *row, *before, *after, *above, *below;
};

/// Keeps the strongest ridge of every column. Bytes and no branch, so that the compiler takes sixteen columns
/// at a time.
void KeepRidges(const RowsAround& rows, std::uint8_t number, int width, std::uint8_t* __restrict strength,
                std::uint8_t* __restrict group) {
  const std::uint8_t *row = rows.row, *before = rows.before, *after = rows.after;
  const std::uint8_t *above = rows.above, *below = rows.below;
  for (int u = 0; u < width; ++u) {
    const std::uint8_t beside = (before[u] + after[u] + 1) >> 1;
    const std::uint8_t middle = (beside + row[u] + 1) >> 1;
    const std::uint8_t a = above[u], b = below[u], old = strength[u];
    const std::uint8_t ground = a > b ? a : b;
    const std::uint8_t ridge = (middle > ground ? middle : ground) - ground;
    const std::uint8_t is_new = ridge > old ? 0xFF : 0;
    group[u] = (number & is_new) | (group[u] & static_cast<std::uint8_t>(~is_new));
    strength[u] = ridge > old ? ridge : old;
  }
}

/// Rows at either border in which no line is looked for: the filters need what lies around.
int MarginOf(const StripeOptions& options) {
  return std::max(options.reach_px + kSide, kTaps + 1);
}

}  // namespace

void StripeFinder::FindRidges(const GreyImage& image, int most) {
  const int width = image.width, reach = options_.reach_px, margin = MarginOf(options_);
  const int rows = image.height - 2 * margin;
  rows_per_group_ = image.height / 256 + 1;  // so that their number fits into a byte
  slabs_ = most == 1 ? 1 : (rows + kSlab_px - 1) / kSlab_px;
  const std::size_t cells = static_cast<std::size_t>(slabs_) * static_cast<std::size_t>(width);
  strength_.assign(cells, 0);
  row_group_.assign(cells, 0);
  const std::ptrdiff_t reach_bytes = std::ptrdiff_t{reach} * width;
  for (int v = margin; v < image.height - margin; ++v) {
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * width;
    const std::ptrdiff_t slab = std::ptrdiff_t{width} * ((v - margin) * slabs_ / rows);
    KeepRidges({row, row - width, row + width, row - reach_bytes, row + reach_bytes},
               static_cast<std::uint8_t>(v / rows_per_group_), width, strength_.data() + slab,
               row_group_.data() + slab);
  }
}

std::size_t StripeFinder::Strongest(int width, int u) const {
  std::size_t best = static_cast<std::size_t>(u);
  for (std::size_t cell = best; cell < strength_.size(); cell += static_cast<std::size_t>(width)) {
    if (strength_[cell] > strength_[best]) best = cell;
  }
  return best;
}

void StripeFinder::Measure(const GreyImage& image, int u, std::uint8_t group,
                           std::vector<RidgeAt>& found) const {
  const int first = MarginOf(options_), last = image.height - 1 - first;
  const Column column(image, u);
  const int begin = group * rows_per_group_;
  const int row = BrightestRow(column, std::max(first, begin - 1), std::min(last, begin + rows_per_group_));
  const auto ridge = Refine(column, row, first, last, options_.reach_px);
  if (!ridge || ridge->contrast < options_.min_contrast) return;
  for (const RidgeAt& other : found) {
    if (std::abs(other.point.at.y() - ridge->v) < options_.reach_px) return;  // seen from the slab beside it
  }
  found.push_back({{{u, ridge->v}, ridge->contrast, ridge->gain, ridge->least_contrast}, ridge->roughness});
}

/// Where the line is hidden, an edge of what hides it may look like a faint piece of it, of one side at
/// least.
void StripeFinder::DropFaint(std::vector<StripePoint>& points) const {
  if (points.empty()) return;
  std::vector<double> contrasts;
  contrasts.reserve(points.size());
  for (const StripePoint& p : points) contrasts.push_back(p.least_contrast);
  const auto middle = contrasts.begin() + static_cast<std::ptrdiff_t>(contrasts.size() / 2);
  std::ranges::nth_element(contrasts, middle);
  const double least = options_.min_share * *middle;
  std::erase_if(points, [&](const StripePoint& p) { return p.least_contrast < least; });
}

void StripeFinder::DropGlints(std::vector<StripePoint>& points) const {
  std::vector<StripePoint> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && points[end].at.x() - points[end - 1].at.x() <= 2 &&
           std::abs(points[end].at.y() - points[end - 1].at.y()) <= options_.max_step_px)
      ++end;
    if (points[end - 1].at.x() - points[begin].at.x() + 1 >= options_.min_length_px)
      kept.insert(kept.end(), points.begin() + begin, points.begin() + end);
    begin = end;
  }
  points.swap(kept);
}

void StripeFinder::Smooth(std::vector<StripePoint>& points) const {
  const std::vector<StripePoint> raw = points;
  const auto n = static_cast<std::ptrdiff_t>(raw.size());
  const auto joined = [&](std::ptrdiff_t a, std::ptrdiff_t b) {
    return raw[b].at.x() - raw[a].at.x() == 1 &&
           std::abs(raw[b].at.y() - raw[a].at.y()) <= options_.max_step_px;
  };
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = raw[i].at.y(), variance = raw[i].sigma_px * raw[i].sigma_px, count = 1;
    for (std::ptrdiff_t d = 1; d <= options_.smooth_px && i - d >= 0 && i + d < n; ++d) {
      if (!joined(i - d, i - d + 1) || !joined(i + d - 1, i + d)) break;
      sum += raw[i - d].at.y() + raw[i + d].at.y();
      count += 2;
      variance += raw[i - d].sigma_px * raw[i - d].sigma_px + raw[i + d].sigma_px * raw[i + d].sigma_px;
    }
    points[i].at.y() = sum / count;
    points[i].sigma_px = std::hypot(std::sqrt(variance) / count, kSystematic_px);
  }
}

std::vector<StripePoint> StripeFinder::Ridges(const GreyImage& image, int most) {
  std::vector<StripePoint> points;
  if (image.height <= 2 * MarginOf(options_) || image.width < 3) return points;
  FindRidges(image, most);
  double roughness = 0;
  std::vector<RidgeAt> found;
  for (int u = 0; u < image.width; ++u) {
    found.clear();
    // One ridge may be the strongest of two slabs side by side, and be measured twice.
    for (int tries = 2 * most - 1; tries > 0 && std::ssize(found) < most; --tries) {
      const std::size_t cell = Strongest(image.width, u);
      // The ridge filter loses a part of narrow lines: the exact contrast is judged afterwards.
      if (strength_[cell] < options_.min_contrast / 2) break;
      strength_[cell] = 0;
      Measure(image, u, row_group_[cell], found);
    }
    std::ranges::sort(found, {}, [](const RidgeAt& r) { return r.point.at.y(); });
    for (const RidgeAt& ridge : found) {
      points.push_back(ridge.point);
      roughness += ridge.roughness;
    }
  }
  // Half of the mean square of differences is the variance of a pixel.
  const double noise = points.empty() ? 0 : std::sqrt(std::max(0.1, roughness / 2 / points.size()));
  for (StripePoint& p : points) p.sigma_px *= noise;
  return points;
}

std::vector<StripePoint> StripeFinder::Trace(std::vector<StripePoint> points) const {
  DropFaint(points);
  DropGlints(points);
  Smooth(points);
  return points;
}

std::vector<std::vector<StripePoint>> StripeFinder::FindInOrder(const GreyImage& image, int n) {
  const std::vector<StripePoint> ridges = Ridges(image, n);
  std::vector<std::vector<StripePoint>> lines(static_cast<std::size_t>(n));
  for (std::size_t begin = 0, end = 0; begin < ridges.size(); begin = end) {
    while (end < ridges.size() && ridges[end].at.x() == ridges[begin].at.x()) ++end;
    if (end - begin != lines.size()) continue;
    for (std::size_t k = 0; k < lines.size(); ++k) lines[k].push_back(ridges[begin + k]);
  }
  for (std::vector<StripePoint>& line : lines) line = Trace(std::move(line));
  return lines;
}

}  // namespace priamos::head
