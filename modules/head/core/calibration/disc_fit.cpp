#include "head/core/calibration/disc_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kRimReach_px = 2.5;   // beyond the half-level rim: where a sharp rim has faded
constexpr double kRingWidth_px = 2.0;  // of the ring that gives the background
constexpr double kPixelVariance = 1.0 / 12;
constexpr int kFitSteps = 5;
constexpr double kConverged_px = 1.5e-3;
constexpr double kMarginSlack_px = 1;  // for the fit to move within
constexpr double kForeign = 0.1, kForeignLevels = 10;
// What lamps and vignetting do at most, as a standard deviation. It keeps the slopes from being traded
// against the centre where a disc is small or blurred.
constexpr double kSlopePrior_per_px = 0.001;
constexpr double kBackgroundSlopePrior_per_px = 0.2;

/// Grown by `px` along both semi-axes.
Ellipse Grown(const Ellipse& ellipse, double px) {
  const double scale = 1 + px / std::max(0.5, std::sqrt(ellipse.SemiMajor() * ellipse.SemiMinor()));
  return {ellipse.centre_px, ellipse.shape_px2 * scale * scale};
}

struct Box {
  int u0, u1, v0, v1;
};

/// The pixels of the ellipse's bounding box; nullopt if it leaves the image.
std::optional<Box> BoundingBox(const GreyImage& image, const Ellipse& e) {
  const double du = std::sqrt(e.shape_px2(0, 0)), dv = std::sqrt(e.shape_px2(1, 1));
  const Vector2d& c = e.centre_px;
  const bool inside =
      c.x() - du >= 0 && c.x() + du <= image.width - 1 && c.y() - dv >= 0 && c.y() + dv <= image.height - 1;
  if (!inside) return std::nullopt;  // also when anything is NaN
  return Box{static_cast<int>(std::ceil(c.x() - du)), static_cast<int>(c.x() + du),
             static_cast<int>(std::ceil(c.y() - dv)), static_cast<int>(c.y() + dv)};
}

bool Within(const Ellipse& e, double u, double v) {
  const Vector2d d = Vector2d(u, v) - e.centre_px;
  const Matrix2d& m = e.shape_px2;
  const double det = m.determinant();
  return m(1, 1) * d.x() * d.x() - 2 * m(0, 1) * d.x() * d.y() + m(0, 0) * d.y() * d.y() < det;
}

/// Calls visit(offset from the centre, q^2, grey value) for every pixel within the ellipse (q^2 <= 1) that
/// is not within one of the others.
template <class Visit>
void ForEachPixel(const GreyImage& image, const Box& box, const Ellipse& e, std::span<const Ellipse> others,
                  const Visit& visit) {
  const Matrix2d k = e.shape_px2.inverse();
  for (int v = box.v0; v <= box.v1; ++v) {
    const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * image.width;
    const double dy = v - e.centre_px.y();
    for (int u = box.u0; u <= box.u1; ++u) {
      const double dx = u - e.centre_px.x();
      const double q2 = k(0, 0) * dx * dx + 2 * k(0, 1) * dx * dy + k(1, 1) * dy * dy;
      if (q2 > 1) continue;
      const auto hides = [&](const Ellipse& other) { return Within(other, u, v); };
      if (std::any_of(others.begin(), others.end(), hides)) continue;
      visit(dx, dy, q2, row[u]);
    }
  }
}

/// The value below which `share` of the histogram lies, and -1 if the histogram is empty. Interpolated
/// within the grey level, as if each level were spread over one.
double Quantile(const std::array<int, 256>& histogram, double share) {
  double total = 0;
  for (const int n : histogram) total += n;
  if (total == 0) return -1;
  double below = 0;
  for (int level = 0; level < 256; ++level) {
    if (below + histogram[level] >= share * total && histogram[level] > 0) {
      return level - 0.5 + (share * total - below) / histogram[level];
    }
    below += histogram[level];
  }
  return 255;
}

/// Medians of the ring around the disc and of its inner part.
bool MeasureLevels(const GreyImage& image, const Ellipse& guess, std::span<const Ellipse> others,
                   DetectedDisc& disc) {
  const Ellipse inner_rim = Grown(guess, kRimReach_px),
                outer_rim = Grown(guess, kRimReach_px + kRingWidth_px);
  const std::optional<Box> box = BoundingBox(image, outer_rim);
  if (!box) return false;
  const double inner = inner_rim.shape_px2.determinant() / outer_rim.shape_px2.determinant();
  const double core = 0.36 * guess.shape_px2.determinant() / outer_rim.shape_px2.determinant();
  const double inner_q2 = std::sqrt(inner), core_q2 = std::sqrt(core);
  std::array<int, 256> ring{}, plateau{};
  ForEachPixel(image, *box, outer_rim, others, [&](double, double, double q2, std::uint8_t grey) {
    if (q2 > inner_q2) ++ring[grey];
    if (q2 < core_q2) ++plateau[grey];
  });
  const double top = Quantile(plateau, 0.5);
  disc.background = Quantile(ring, 0.5);
  disc.amplitude = top - disc.background;
  return top >= 0 && disc.background >= 0 && disc.amplitude > 1;
}

/// The ellipse with the moments of what stands out of the background within the window.
std::optional<Ellipse> MomentsWithin(const GreyImage& image, const Ellipse& window,
                                     std::span<const Ellipse> others, const DetectedDisc& levels) {
  const std::optional<Box> box = BoundingBox(image, window);
  if (!box) return std::nullopt;
  double sum = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  ForEachPixel(image, *box, window, others, [&](double dx, double dy, double, std::uint8_t grey) {
    const double weight = grey - levels.background;
    sum += weight;
    x += weight * dx;
    y += weight * dy;
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
  });
  if (sum < levels.amplitude) return std::nullopt;
  const Vector2d mean(x / sum, y / sum);
  Matrix2d covariance;
  covariance << xx / sum, xy / sum, xy / sum, yy / sum;
  covariance -= mean * mean.transpose();
  // A uniform ellipse has covariance shape/4; the pixels' extent is taken off, the unknown blur is not.
  const Ellipse found{window.centre_px + mean, 4 * (covariance - kPixelVariance * Matrix2d::Identity())};
  const bool positive = found.shape_px2(0, 0) > 0.5 && found.shape_px2.determinant() > 0.25;
  return positive ? std::optional(found) : std::nullopt;
}

/// Phi and phi of the standard normal distribution, tabulated over +-kReach.
class NormalTable {
 public:
  static constexpr double kReach = 3.3;
  NormalTable() {
    for (int i = 0; i <= kSteps; ++i) {
      const double z = (i - kSteps / 2) / kPerUnit;
      cdf_[i] = 0.5 * std::erfc(-z / std::sqrt(2.0));
      pdf_[i] = std::exp(-z * z / 2) / std::sqrt(2 * kPi);
    }
  }
  /// {Phi, phi} at z within +-kReach.
  std::pair<double, double> operator()(double z) const {
    const double x = z * kPerUnit + kSteps / 2.0;
    const int i = std::clamp(static_cast<int>(x), 0, kSteps - 1);
    const double t = x - i;
    return {cdf_[i] + t * (cdf_[i + 1] - cdf_[i]), pdf_[i] + t * (pdf_[i + 1] - pdf_[i])};
  }

 private:
  static constexpr int kSteps = 1024;
  static constexpr double kPerUnit = kSteps / (2 * kReach);
  std::array<double, kSteps + 1> cdf_, pdf_;
};

/// The parameters of the grey-value model. By symmetry the odd ones (centre, slopes) and the even ones
/// (brightness, shape, rim width) do not disturb each other, so each group has its own normal equations.
struct Model {
  Vector2d centre;
  Matrix2d k;  ///< inverse shape
  double rim_sigma, amplitude, background;
  Vector2d slope = Vector2d::Zero();             ///< of the brightness inside, relative, per px
  Vector2d background_slope = Vector2d::Zero();  ///< per px
};

struct NormalEquations {
  Matrix6d odd = Matrix6d::Zero(), even = Matrix6d::Zero();
  Vector6d odd_rhs = Vector6d::Zero(), even_rhs = Vector6d::Zero();
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
  /// As pixels with the model's amplitude (inside) or none (outside).
  void AddTo(NormalEquations& eq, double amplitude) const {
    Matrix2d moments;
    moments << xx, xy, xy, yy;
    eq.odd.block<2, 2>(2, 2) += amplitude * amplitude * moments;
    eq.odd.block<2, 2>(2, 4) += amplitude * moments;
    eq.odd.block<2, 2>(4, 2) += amplitude * moments;
    eq.odd.block<2, 2>(4, 4) += moments;
    eq.odd_rhs.segment<2>(2) += amplitude * Vector2d(rx, ry);
    eq.odd_rhs.segment<2>(4) += Vector2d(rx, ry);
    if (amplitude > 0) {
      eq.even.topLeftCorner<2, 2>().array() += n;
      eq.even_rhs.head<2>().array() += r;
    } else {
      eq.even(1, 1) += n;
      eq.even_rhs(1) += r;
    }
    eq.squares += squares;
    eq.pixels += static_cast<int>(n);
  }
};

/// The same sums of grey values, which no model changes: taken once for the pixels deep inside the disc.
struct GreySums {
  double n = 0, g = 0, gg = 0;
  Vector2d x = Vector2d::Zero(), gx = Vector2d::Zero();
  Matrix2d xx = Matrix2d::Zero();

  /// Pixels of one row, from u0 to u1, with coordinates from (origin_u, origin_v).
  void AddRow(const std::uint8_t* row, int u0, int u1, double origin_u, double dy) {
    int sum = 0, weighted = 0, squares = 0;
    for (int u = u0; u <= u1; ++u) {
      sum += row[u];
      weighted += row[u] * (u - u0);
      squares += row[u] * row[u];
    }
    const double count = u1 - u0 + 1, first = u0 - origin_u, last = count - 1;
    const double sum_x = count * (first + last / 2);
    n += count;
    g += sum;
    gg += squares;
    x += Vector2d(sum_x, count * dy);
    gx += Vector2d(weighted + first * sum, sum * dy);
    const double sum_xx = count * first * first + first * last * count + last * count * (2 * last + 1) / 6;
    xx(0, 0) += sum_xx;
    xx(0, 1) += sum_x * dy;
    xx(1, 0) += sum_x * dy;
    xx(1, 1) += count * dy * dy;
  }
  /// The residuals against level + slope * (x + shift).
  FlatPixels Against(double level, const Vector2d& slope, const Vector2d& shift) const {
    const Vector2d d = x + n * shift, gd = gx + g * shift;
    const Matrix2d dd = xx + shift * x.transpose() + x * shift.transpose() + n * shift * shift.transpose();
    const Vector2d rd = gd - level * d - dd * slope;
    FlatPixels flat;
    flat.n = n;
    flat.r = g - level * n - slope.dot(d);
    flat.rx = rd.x();
    flat.ry = rd.y();
    flat.xx = dd(0, 0);
    flat.xy = dd(0, 1);
    flat.yy = dd(1, 1);
    flat.squares = gg - 2 * level * g - 2 * slope.dot(gd) + level * level * n + 2 * level * slope.dot(d) +
                   slope.dot(dd * slope);
    return flat;
  }
};

/// The pixels of a window: those within `margin_px` of the rim or outside one by one, the core as sums.
struct WindowPixels {
  struct Pixel {
    float dx, dy, grey;  ///< from the centre of the window
  };
  std::vector<Pixel> shell;
  GreySums core;
  double margin_px = 0;

  void Collect(const GreyImage& image, const Ellipse& disc, const Ellipse& window,
               std::span<const Ellipse> others, double margin) {
    const std::optional<Box> box = BoundingBox(image, window);
    margin_px = margin;
    shell.clear();
    core = {};
    if (!box) return;
    const double share = others.empty() ? std::max(0.0, 1 - margin / disc.SemiMinor()) : 0;
    const Matrix2d k = window.shape_px2.inverse();
    const double core_q2 = share * share * std::sqrt(disc.shape_px2.determinant() * k.determinant());
    for (int v = box->v0; v <= box->v1; ++v) {
      const std::uint8_t* row = image.pixels.data() + static_cast<std::size_t>(v) * image.width;
      const double dy = v - window.centre_px.y();
      // Where the row crosses the core: k00 dx^2 + 2 k01 dx dy + k11 dy^2 = core_q2.
      const double half_b = k(0, 1) * dy / k(0, 0);
      const double discriminant = half_b * half_b - (k(1, 1) * dy * dy - core_q2) / k(0, 0);
      int first = 1, last = 0;
      if (discriminant > 0) {
        first = static_cast<int>(std::ceil(window.centre_px.x() - half_b - std::sqrt(discriminant)));
        last = static_cast<int>(std::floor(window.centre_px.x() - half_b + std::sqrt(discriminant)));
      }
      if (first <= last) core.AddRow(row, first, last, window.centre_px.x(), dy);
      for (int u = box->u0; u <= box->u1; ++u) {
        if (u == first && first <= last) u = last + 1;
        if (u > box->u1) break;
        const double dx = u - window.centre_px.x();
        if (k(0, 0) * dx * dx + 2 * k(0, 1) * dx * dy + k(1, 1) * dy * dy > 1) continue;
        const auto hides = [&](const Ellipse& other) { return Within(other, u, v); };
        if (std::any_of(others.begin(), others.end(), hides)) continue;
        shell.push_back({static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(row[u])});
      }
    }
  }
};

const NormalTable& Normal() {
  static const NormalTable kTable;
  return kTable;
}

/// Sums the normal equations over the pixels of one disc.
class Accumulator {
 public:
  explicit Accumulator(const Model& model) : m_(model), normal_(Normal()) {
    const double reach = NormalTable::kReach * m_.rim_sigma;
    const Ellipse shape{m_.centre, m_.k.inverse()};
    const double minor = std::max(0.5, shape.SemiMinor());
    const double inner = std::max(0.3, 1 - reach / minor), outer = 1 + reach / minor;
    inside_q2_ = inner * inner;
    outside_q2_ = outer * outer;
  }

  /// The pixel at (dx, dy) from the centre with value `grey`.
  void Add(double dx, double dy, double grey) {
    const double kx = m_.k(0, 0) * dx + m_.k(0, 1) * dy, ky = m_.k(0, 1) * dx + m_.k(1, 1) * dy;
    const double q2 = kx * dx + ky * dy;
    const double shading = m_.amplitude * (1 + m_.slope.x() * dx + m_.slope.y() * dy);
    const double rest = grey - m_.background - m_.background_slope.x() * dx - m_.background_slope.y() * dy;
    if (q2 < inside_q2_) {
      inside_.Add(dx, dy, rest - shading);
    } else if (q2 > outside_q2_) {
      // The ground may end near the disc: what is far from its level belongs to something else.
      if (std::abs(rest) < kForeign * m_.amplitude + kForeignLevels) outside_.Add(dx, dy, rest);
    } else {
      AddRim(dx, dy, kx, ky, q2, rest, shading);
    }
  }

  /// Pixels of which the model knows that they lie inside.
  void AddCore(const GreySums& core, const Vector2d& shift) {
    const Vector2d slope = m_.amplitude * m_.slope + m_.background_slope;
    core.Against(m_.amplitude + m_.background, slope, shift).AddTo(eq_, m_.amplitude);
  }

  NormalEquations Finish() {
    inside_.AddTo(eq_, m_.amplitude);
    outside_.AddTo(eq_, 0);
    return eq_;
  }

 private:
  void AddRim(double dx, double dy, double kx, double ky, double q2, double rest, double shading) {
    const double inverse_norm = 1 / std::sqrt(kx * kx + ky * ky), q = std::sqrt(q2);
    // First-order distance to the rim, positive inside.
    const double z = (1 - q) * q * inverse_norm / m_.rim_sigma;
    const auto [share, density] = normal_(std::clamp(z, -NormalTable::kReach, NormalTable::kReach));
    const double residual = rest - shading * share;
    const double per_distance = m_.amplitude * density / m_.rim_sigma;
    const double per_k = -per_distance * inverse_norm / 2, lit = m_.amplitude * share;
    Vector6d odd, even;
    odd << per_distance * kx * inverse_norm, per_distance * ky * inverse_norm, lit * dx, lit * dy, dx, dy;
    even << share, 1, per_k * dx * dx, 2 * per_k * dx * dy, per_k * dy * dy, -per_distance * z;
    eq_.odd.noalias() += odd * odd.transpose();
    eq_.even.noalias() += even * even.transpose();
    eq_.odd_rhs += residual * odd;
    eq_.even_rhs += residual * even;
    eq_.squares += residual * residual;
    ++eq_.pixels;
  }

  const Model& m_;
  const NormalTable& normal_;
  double inside_q2_, outside_q2_;
  NormalEquations eq_;
  FlatPixels inside_, outside_;
};

Vector6d SolveDamped(Matrix6d m, const Vector6d& rhs) {
  m.diagonal() *= 1 + 1e-6;
  m.diagonal().array() += 1e-12;
  return m.ldlt().solve(rhs);
}

/// The odd equations with the prior of the slopes added.
void AddPrior(const Model& m, NormalEquations& eq) {
  const double variance = std::max(0.5, eq.squares / eq.pixels);
  const double weight = variance / (kSlopePrior_per_px * kSlopePrior_per_px);
  const double ground_weight = variance / (kBackgroundSlopePrior_per_px * kBackgroundSlopePrior_per_px);
  for (int i = 0; i < 2; ++i) {
    eq.odd(2 + i, 2 + i) += weight;
    eq.odd_rhs(2 + i) -= weight * m.slope(i);
    eq.odd(4 + i, 4 + i) += ground_weight;
    eq.odd_rhs(4 + i) -= ground_weight * m.background_slope(i);
  }
}

void Step(const NormalEquations& eq, Model& m) {
  const Vector6d odd = SolveDamped(eq.odd, eq.odd_rhs), even = SolveDamped(eq.even, eq.even_rhs);
  m.centre += odd.head<2>();
  m.slope += odd.segment<2>(2);
  m.background_slope += odd.tail<2>();
  m.amplitude += even(0);
  m.background += even(1);
  m.k(0, 0) += even(2);
  m.k(0, 1) += even(3);
  m.k(1, 0) += even(3);
  m.k(1, 1) += even(4);
  m.rim_sigma = std::clamp(m.rim_sigma + even(5), 0.28, 6.0);
}

bool Sane(const Model& m, const DetectedDisc& start) {
  const double ratio = m.k.determinant() * start.ellipse.shape_px2.determinant();
  return m.k(0, 0) > 0 && ratio > 0.2 && ratio < 5 && m.amplitude > 1 &&
         (m.centre - start.ellipse.centre_px).norm() < 0.3 * start.ellipse.SemiMajor() + 0.5;
}

DetectedDisc Result(const Model& m, const NormalEquations& eq) {
  DetectedDisc disc;
  disc.ellipse = {m.centre, m.k.inverse()};
  disc.background = m.background;
  disc.amplitude = m.amplitude;
  disc.blur_sigma_px = std::sqrt(std::max(0.0, m.rim_sigma * m.rim_sigma - kPixelVariance));
  const double variance = eq.squares / std::max(1, eq.pixels - 12);
  disc.residual = std::sqrt(variance);
  const Matrix6d inverse = eq.odd.ldlt().solve(Matrix6d::Identity());
  disc.sigma_px = std::sqrt(variance * (inverse(0, 0) + inverse(1, 1)) / 2);
  return disc;
}

}  // namespace

std::optional<DetectedDisc> MeasureMoments(const GreyImage& image, const Ellipse& guess,
                                           std::span<const Ellipse> others) {
  DetectedDisc disc;
  if (!MeasureLevels(image, guess, others, disc)) return std::nullopt;
  disc.ellipse = guess;
  // The second pass has the window in the right place and of the right shape.
  for (int pass = 0; pass < 2; ++pass) {
    const std::optional<Ellipse> next = MomentsWithin(image, Grown(disc.ellipse, kRimReach_px), others, disc);
    if (!next) return std::nullopt;
    disc.ellipse = *next;
  }
  disc.blur_sigma_px = 0.7;
  return disc;
}

std::optional<DetectedDisc> FitDisc(const GreyImage& image, const DetectedDisc& start,
                                    std::span<const Ellipse> others) {
  const Matrix2d blur = 4 * start.blur_sigma_px * start.blur_sigma_px * Matrix2d::Identity();
  Matrix2d shape = start.ellipse.shape_px2 - blur;
  if (shape(0, 0) < 1 || shape.determinant() < 1) shape = start.ellipse.shape_px2;
  Model model{start.ellipse.centre_px, shape.inverse(),
              std::sqrt(start.blur_sigma_px * start.blur_sigma_px + kPixelVariance), start.amplitude,
              start.background};
  const Ellipse window = Grown(start.ellipse, kRimReach_px + 1);
  if (!BoundingBox(image, window)) return std::nullopt;
  WindowPixels pixels;
  NormalEquations eq;
  for (int i = 0; i < kFitSteps; ++i) {
    const double fade_px = NormalTable::kReach * model.rim_sigma;
    if (fade_px > pixels.margin_px) {
      pixels.Collect(image, {window.centre_px, shape}, window, others, fade_px + kMarginSlack_px);
    }
    Accumulator sums(model);
    const Vector2d shift = window.centre_px - model.centre;
    for (const auto& p : pixels.shell) sums.Add(p.dx + shift.x(), p.dy + shift.y(), p.grey);
    sums.AddCore(pixels.core, shift);
    eq = sums.Finish();
    if (eq.pixels < 15) return std::nullopt;
    AddPrior(model, eq);
    const Vector2d before = model.centre;
    Step(eq, model);
    if (!Sane(model, start)) return std::nullopt;
    if (i > 0 && (model.centre - before).norm() < kConverged_px) break;
  }
  return Result(model, eq);
}

}  // namespace priamos::head
