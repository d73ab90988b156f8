#include "head/core/stereo/grey_relation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace priamos::head {
namespace {

constexpr double kWhite = 255, kMiddle = 128, kDarkest = 1;
constexpr double kReach = 16;           ///< difference of grey values that explains nothing any more
constexpr std::size_t kMaxLines = 150;  ///< the longest ones are enough
/// Another relation than "no change" has to explain so much more: lines, and share of the lines.
constexpr double kMoreLines = 1.5, kMoreShare = 0.04;

/// What a pair of lines says: the grey values on both sides in both images.
struct Observation {
  int line = 0;                    ///< its first line; those of one line follow each other
  std::array<double, 2> from, to;  ///< dark and bright side
  double far_first = 0, far_second = 0;
};

std::vector<Observation> Observe(const CameraView& first, const CameraView& second,
                                 const std::vector<LinePair>& pairs) {
  std::vector<double> lengths;
  for (const ViewLine& line : first.lines) lengths.push_back(line.length_px);
  std::sort(lengths.rbegin(), lengths.rend());
  const double shortest = lengths.size() > kMaxLines ? lengths[kMaxLines] : 0;
  std::vector<Observation> all;
  for (const LinePair& pair : pairs) {
    const ViewLine &a = first.lines[pair.first], &b = second.lines[pair.second];
    if (a.length_px < shortest) continue;
    const EdgeSegment &s = first.edges->segments[a.segment], &t = second.edges->segments[b.segment];
    all.push_back({pair.first,
                   {s.grey_left, s.grey_right},
                   {t.grey_left, t.grey_right},
                   FarFromCentre(first, a),
                   FarFromCentre(second, b)});
  }
  return all;
}

/// How well the grey values that a relation predicts explain one pair, 0 to 1: the side that fits better
/// counts more, and a contrast that a relation takes away explains nothing.
double Fit(double dark, double bright, const Observation& o, double reach) {
  const double contrast = bright - dark, seen = o.to[1] - o.to[0];
  if (contrast > 2 * seen || seen > 2 * contrast) return 0;
  const double a = std::abs(o.to[0] - dark) / reach, b = std::abs(o.to[1] - bright) / reach;
  return std::max(0.0, 1 - std::min(a, b)) * (0.5 + 0.5 * std::max(0.0, 1 - std::max(a, b)));
}

double Fit(const GreyRelation& relation, const Observation& o) {
  return Fit(relation.Of(o.from[0], o.far_first, o.far_second),
             relation.Of(o.from[1], o.far_first, o.far_second), o,
             kReach * std::sqrt(relation.Slope(o.far_first, o.far_second)));
}

/// Calls `use(observation, fit)` with the best partner of every line.
template <typename FitOf, typename Use>
void ForBest(std::span<const Observation> all, const FitOf& fit_of, const Use& use) {
  for (std::size_t i = 0; i < all.size();) {
    const Observation* best = nullptr;
    double best_fit = 0;
    const int line = all[i].line;
    for (; i < all.size() && all[i].line == line; ++i) {
      const double fit = fit_of(all[i]);
      if (fit > best_fit) {
        best = &all[i];
        best_fit = fit;
      }
    }
    if (best) use(*best, best_fit);
  }
}

/// How many lines have a partner, each counted by how well it fits.
template <typename FitOf>
double Explained(std::span<const Observation> all, const FitOf& fit_of) {
  double sum = 0;
  ForBest(all, fit_of, [&](const Observation&, double fit) { sum += fit; });
  return sum;
}

double Explained(std::span<const Observation> all, const GreyRelation& relation) {
  return Explained(all, [&](const Observation& o) { return Fit(relation, o); });
}

/// The best relation of one tone curve, without falloff, if it is better than `best`.
void SearchWith(double gamma, std::vector<Observation> all, double& most, GreyRelation& best) {
  for (Observation& o : all)
    for (double& grey : o.from) grey = GreyRelation{.gamma = gamma}.Of(grey);
  for (int step = -5; step <= 5; ++step)
    for (const double offset : {-40.0, -20.0, 0.0, 20.0, 40.0}) {
      const GreyRelation tried{.gain = std::pow(1.2, step), .gamma = gamma, .offset = offset};
      const double reach = kReach * std::sqrt(tried.Slope());
      const auto predicted = [&](double grey) { return std::clamp(tried.gain * grey + offset, 0.0, kWhite); };
      const double explained = Explained(all, [&](const Observation& o) {
        return Fit(predicted(o.from[0]), predicted(o.from[1]), o, reach);
      });
      if (explained <= most) continue;
      most = explained;
      best = tried;
    }
}

/// One step of a robust least-squares fit to the best partners; what is not determined stays.
GreyRelation Refined(std::span<const Observation> all, const GreyRelation& relation) {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  constexpr double kSigma = 4;  // of grey values beside an edge, between two images
  const Vector5 loose = (Vector5() << 1, 1, 30, 0.5, 0.5).finished();
  Eigen::Matrix<double, 5, 5> normal = loose.cwiseAbs2().cwiseInverse().asDiagonal();
  Vector5 right = Vector5::Zero();
  const auto fit_of = [&](const Observation& o) { return Fit(relation, o); };
  ForBest(all, fit_of, [&](const Observation& o, double) {
    for (int side = 0; side < 2; ++side) {
      const double predicted = relation.Of(o.from[side], o.far_first, o.far_second);
      if (predicted <= 0 || predicted >= kWhite || o.to[side] >= kWhite - 1 || o.from[side] >= kWhite - 1)
        continue;
      const double error = o.to[side] - predicted;
      const double light = predicted - relation.offset;
      const double centre =
          light / (1 + relation.falloff_first * o.far_first + relation.falloff_second * o.far_second);
      const Vector5 slope = (Vector5() << light, light * std::log(std::max(o.from[side], kDarkest) / kWhite),
                             1, centre * o.far_first, centre * o.far_second)
                                .finished();
      const double weight = 1 / (kSigma * kSigma + error * error);
      normal += weight * slope * slope.transpose();
      right += weight * error * slope;
    }
  });
  const Vector5 step = normal.ldlt().solve(right);
  return {.gain = relation.gain * std::exp(std::clamp(step[0], -0.3, 0.3)),
          .gamma = std::clamp(relation.gamma + step[1], 0.4, 2.5),
          .offset = relation.offset + step[2],
          .falloff_first = std::clamp(relation.falloff_first + step[3], -0.7, 1.5),
          .falloff_second = std::clamp(relation.falloff_second + step[4], -0.7, 1.5)};
}

}  // namespace

double GreyRelation::Of(double grey, double far_first, double far_second) const {
  const double light = kWhite * gain * std::pow(std::max(grey, 0.0) / kWhite, gamma) *
                       std::max(0.1, 1 + falloff_first * far_first + falloff_second * far_second);
  return std::clamp(light + offset, 0.0, kWhite);
}

double GreyRelation::Slope(double far_first, double far_second) const {
  return gain * gamma * std::pow(kMiddle / kWhite, gamma - 1) *
         std::max(0.1, 1 + falloff_first * far_first + falloff_second * far_second);
}

double FarFromCentre(const CameraView& view, const ViewLine& line) {
  const Eigen::Vector2d half(view.size.width / 2.0, view.size.height / 2.0);
  return ((line.p + line.q) / 2 - half).squaredNorm() / half.squaredNorm();
}

GreyRelation EstimateGreyRelation(const CameraView& first, const CameraView& second,
                                  const std::vector<LinePair>& pairs) {
  constexpr int kRounds = 8;
  const std::vector<Observation> all = Observe(first, second, pairs);
  const GreyRelation unchanged;
  GreyRelation best;
  double most = 0;
  for (const double gamma : {0.5, 0.7, 1.0, 1.4, 2.0}) SearchWith(gamma, all, most, best);
  GreyRelation moving = best;
  for (int round = 0; round < kRounds; ++round) {
    moving = Refined(all, moving);
    const double explained = Explained(all, moving);
    if (explained <= most) continue;
    most = explained;
    best = moving;
  }
  const double as_it_is = Explained(all, unchanged);
  return most > as_it_is + kMoreLines && most > (1 + kMoreShare) * as_it_is ? best : unchanged;
}

}  // namespace priamos::head
