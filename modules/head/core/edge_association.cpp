#include "head/core/edge_association.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>

#include "head/core/prediction.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMarksAtOnce = sizeof(std::uint64_t);  ///< most lines are far from most edges
constexpr std::size_t kUsualCandidates = 16;
constexpr int kSides = 4;                  ///< values of LandmarkEdge::side
constexpr double kFullLengthPx = 40;       ///< shorter predictions count less
constexpr double kMinDensity = 0.01;       ///< similar edges per pixel: even a bare wall may hide one
constexpr double kFreeOvershootPx = 6;     ///< ends are not found better than that
constexpr double kOvershootPenalty = 0.2;  ///< log odds lost per pixel beyond
constexpr double kNearlyWhole = 0.6;       ///< covered share that counts as a whole edge

/// A line relative to a predicted edge.
struct Candidate {
  int line;
  double from, to;       ///< covered part of the prediction [px]
  double before, after;  ///< how far it runs on beyond both ends of the prediction [px]
  double distance;       ///< signed, at the middle of that part [px]
  bool same_sign;        ///< bright side at the prediction's normal
};

std::optional<Candidate> Compare(const PredictedEdge& edge, const Eigen::Vector2d& direction,
                                 const Eigen::Vector2d& normal, double length, const ViewLine& line,
                                 int index, double reach_px, double max_angle) {
  const double a = normal.dot(line.p - edge.p), b = normal.dot(line.q - edge.p);
  if (std::min(std::abs(a), std::abs(b)) > reach_px && a * b > 0) return std::nullopt;
  const double turn = std::abs(normal.dot(line.q - line.p));
  if (turn > max_angle * line.length_px + 1.0) return std::nullopt;  // one pixel is noise for a short line
  double s = direction.dot(line.p - edge.p), t = direction.dot(line.q - edge.p);
  const double slope = (b - a) / (t - s);
  if (s > t) std::swap(s, t);
  const double from = std::max(s, 0.0), to = std::min(t, length);
  if (to - from < 4) return std::nullopt;
  const double start = direction.dot(line.p - edge.p);
  const double distance = a + slope * ((from + to) / 2 - start);
  if (std::abs(distance) > reach_px) return std::nullopt;
  return Candidate{
      index, from, to, std::max(0.0, -s), std::max(0.0, t - length), distance, normal.dot(line.normal) > 0};
}

/// Marks the lines that Compare may accept: all of them at once, with a little slack for single precision.
void MarkNear(const LineTable& lines, const PredictedEdge& edge, double reach_px, double max_angle,
              std::vector<std::uint8_t>& marks) {
  constexpr float kSlack = 0.01F;
  const Eigen::Vector2f n = edge.normal().cast<float>();
  const float offset = n.dot(edge.p.cast<float>()), reach = static_cast<float>(reach_px) + kSlack;
  const float angle = static_cast<float>(max_angle), one = 1.0F + kSlack;
  marks.assign((lines.px.size() + kMarksAtOnce - 1) / kMarksAtOnce * kMarksAtOnce, 0);
  for (std::size_t i = 0; i < lines.px.size(); ++i) {
    const float a = n.x() * lines.px[i] + n.y() * lines.py[i] - offset;
    const float b = n.x() * lines.qx[i] + n.y() * lines.qy[i] - offset;
    const bool turned = std::abs(b - a) > angle * lines.length[i] + one;
    const bool far = (a > reach && b > reach) || (a < -reach && b < -reach);
    marks[i] = !(turned | far);
  }
}

double Union(std::vector<std::pair<double, double>>& parts) {
  std::sort(parts.begin(), parts.end());
  double covered = 0, end = -1e9;
  for (const auto& [from, to] : parts) {
    covered += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return covered;
}

/// The candidates of one contrast sign within the gate, as one match.
EdgeMatch Collect(const std::vector<Candidate>& candidates, bool sign, const PredictedEdge& predicted,
                  const AssociationOptions& options) {
  const double length = predicted.length_px();
  EdgeMatch match;
  // The nearest long one decides where the edge is; others must continue it, not lie beside it.
  const Candidate* best = nullptr;
  double best_value = 0;
  for (const Candidate& c : candidates) {
    if (c.same_sign != sign || std::abs(c.distance) > options.gate_px) continue;
    const double value =
        (c.to - c.from) * std::exp(-0.5 * c.distance * c.distance / (options.sigma_px * options.sigma_px));
    if (value > best_value) best = &c, best_value = value;
  }
  if (!best) return match;
  std::vector<std::pair<double, double>> parts;
  double sum = 0, weight = 0, before = 0, after = 0;
  for (const Candidate& c : candidates) {
    if (c.same_sign != sign || std::abs(c.distance) > options.gate_px) continue;
    if (std::abs(c.distance - best->distance) > 2 * options.sigma_px) continue;
    match.lines.push_back(c.line);
    parts.emplace_back(c.from, c.to);
    sum += c.distance * (c.to - c.from), weight += c.to - c.from;
    before = std::max(before, c.before), after = std::max(after, c.after);
  }
  match.overshoot_px = (predicted.p_is_end ? before : 0) + (predicted.q_is_end ? after : 0);
  match.covered = std::min(1.0, Union(parts) / length);
  match.distance_px = sum / weight;
  match.predicted_px = length;
  return match;
}

struct Odds {
  double found = 0, missed = 0;
};

/// Log odds of a whole edge at `distance`, and of one that is not there.
Odds EdgeOdds(double distance, double density, const AssociationOptions& options) {
  const double gauss = std::exp(-0.5 * distance * distance / (options.sigma_px * options.sigma_px)) /
                       (options.sigma_px * std::sqrt(2 * kPi));
  const double missed = std::log(1 - options.detection);
  return {std::max(missed, std::log(options.detection * gauss / density + (1 - options.detection))), missed};
}

/// A model edge in one image, on its way to a match.
struct Search {
  PredictedEdge predicted;
  std::vector<Candidate> candidates;
  EdgeMatch match;
  double nearest_px = 1e9;  ///< distance of the next model edge beside it
};

std::vector<Search> Predict(const LandmarkModel& model, std::span<const int> visible, const CameraView& view,
                            const Eigen::Isometry3d& base_from_landmark) {
  std::vector<Search> searches;
  searches.reserve(visible.size());
  for (const int index : visible) {
    const LandmarkEdge& edge = model.edges[index];
    const auto predicted =
        ProjectEdge(*view.camera, view.size, base_from_landmark * edge.from, base_from_landmark * edge.to);
    if (!predicted) continue;
    searches.push_back({*predicted, {}, {}, 1e9});
    searches.back().predicted.edge = index;
    searches.back().candidates.reserve(kUsualCandidates);
  }
  return searches;
}

/// How far beside `a` the edge `b` runs, if they run beside each other.
double Separation(const PredictedEdge& a, const PredictedEdge& b) {
  const Eigen::Vector2d direction = a.direction(), normal = a.normal();
  if (std::abs(normal.dot(b.direction())) > 0.1) return 1e9;
  double s = direction.dot(b.p - a.p), t = direction.dot(b.q - a.p);
  if (s > t) std::swap(s, t);
  if (std::min(t, a.length_px()) - std::max(s, 0.0) < 0.2 * a.length_px()) return 1e9;
  return std::abs(normal.dot((b.p + b.q) / 2 - a.p));
}

/// The operator cannot tell edges apart that lie nearer to each other than its kernels are wide.
void DropCrowded(std::vector<Search>& searches, double min_separation_px) {
  for (Search& a : searches) {
    for (const Search& b : searches) {
      if (&a != &b) a.nearest_px = std::min(a.nearest_px, Separation(a.predicted, b.predicted));
    }
  }
  std::erase_if(searches, [&](const Search& s) { return s.nearest_px < min_separation_px; });
}

/// An image edge belongs to one model edge only: the one it fits best.
void MakeExclusive(std::vector<Search>& searches) {
  for (Search& a : searches) {
    for (Search& b : searches) {
      if (&a == &b) continue;
      const bool shared = std::any_of(a.match.lines.begin(), a.match.lines.end(), [&](int line) {
        return std::find(b.match.lines.begin(), b.match.lines.end(), line) != b.match.lines.end();
      });
      if (!shared) continue;
      const auto worth = [](const EdgeMatch& m) { return m.covered * std::exp(-std::abs(m.distance_px)); };
      (worth(a.match) < worth(b.match) ? a : b).match = EdgeMatch{};
    }
  }
}

/// Similar edges per pixel beside the prediction that no model edge explains: the chance rate of a false
/// match.
double Density(const Search& search, const std::vector<Search>& all, double window_px) {
  const double length = search.predicted.length_px();
  double n = 0;
  for (const Candidate& c : search.candidates) {
    const bool explained = std::any_of(all.begin(), all.end(), [&](const Search& s) {
      return std::find(s.match.lines.begin(), s.match.lines.end(), c.line) != s.match.lines.end();
    });
    if (!explained) n += std::min(1.0, (c.to - c.from) / (kNearlyWhole * length));
  }
  return std::max(kMinDensity, n / (2 * window_px));
}

void Account(const Search& search, int side, double density, int camera, const AssociationOptions& options,
             Association& association) {
  const EdgeMatch& match = search.match;
  const double importance = std::min(1.0, search.predicted.length_px() / kFullLengthPx);
  Odds odds = EdgeOdds(match.distance_px, density, options);
  odds.found = std::max(
      odds.missed, odds.found - kOvershootPenalty * std::max(0.0, match.overshoot_px - kFreeOvershootPx));
  ++association.n_predicted;
  association.side_predicted_px[side] += importance * kFullLengthPx;
  association.best_log_odds += importance * EdgeOdds(0, density, options).found;
  if (match.covered < options.min_covered) {
    association.log_odds += importance * odds.missed;
    return;
  }
  const double part = std::min(1.0, match.covered / kNearlyWhole);
  const double log_odds = importance * (part * odds.found + (1 - part) * odds.missed);
  association.log_odds += log_odds;
  association.side_found_px[side] += importance * kFullLengthPx * part * (odds.found > 0 ? 1 : 0);
  association.matches.push_back(match);
  association.matches.back().edge = search.predicted.edge;
  association.matches.back().camera = camera;
  association.matches.back().log_odds = log_odds;
}

/// Takes the part that may stand elsewhere in, if it was found.
void JoinMovable(Association&& part, Association& all) {
  if (part.log_odds <= 0) return;
  const auto or_elsewhere = [](double log_odds) { return std::log1p(std::exp(log_odds)) + std::log(0.5); };
  all.n_predicted += part.n_predicted;
  all.log_odds += or_elsewhere(part.log_odds);
  all.best_log_odds += or_elsewhere(part.best_log_odds);
  for (std::size_t i = 0; i < all.side_found_px.size(); ++i) {
    all.side_predicted_px[i] += part.side_predicted_px[i];
    all.side_found_px[i] += part.side_found_px[i];
  }
  std::move(part.matches.begin(), part.matches.end(), std::back_inserter(all.matches));
}

void Match(Search& search, const CameraView& view, const AssociationOptions& options,
           std::vector<std::uint8_t>& marks) {
  const double length = search.predicted.length_px();
  const Eigen::Vector2d direction = search.predicted.direction(), normal = search.predicted.normal();
  MarkNear(view.table, search.predicted, options.clutter_window_px, options.max_angle_rad, marks);
  for (std::size_t begin = 0; begin < marks.size(); begin += kMarksAtOnce) {
    std::uint64_t some = 0;
    std::memcpy(&some, &marks[begin], kMarksAtOnce);
    if (!some) continue;
    for (std::size_t i = begin; i < begin + kMarksAtOnce; ++i) {
      if (!marks[i]) continue;
      const auto c = Compare(search.predicted, direction, normal, length, view.lines[i], int(i),
                             options.clutter_window_px, options.max_angle_rad);
      if (c) search.candidates.push_back(*c);
    }
  }
  search.match = Collect(search.candidates, true, search.predicted, options);
  EdgeMatch other = Collect(search.candidates, false, search.predicted, options);
  const auto worth = [](const EdgeMatch& m) { return m.covered * std::exp(-std::abs(m.distance_px)); };
  if (worth(other) > worth(search.match)) search.match = std::move(other);
}

}  // namespace

Association Associate(const LandmarkModel& model, std::span<const int> visible,
                      std::span<const CameraView> views, const Eigen::Isometry3d& base_from_landmark,
                      const AssociationOptions& options) {
  Association association, movable;
  association.missed_log_odds = std::log(1 - options.detection);
  std::vector<std::uint8_t> marks;
  for (std::size_t c = 0; c < views.size(); ++c) {
    std::vector<Search> searches = Predict(model, visible, views[c], base_from_landmark);
    DropCrowded(searches, options.min_separation_px);
    for (Search& search : searches) Match(search, views[c], options, marks);
    MakeExclusive(searches);
    for (const Search& search : searches) {
      const double density = Density(search, searches, options.clutter_window_px);
      const LandmarkEdge& edge = model.edges[search.predicted.edge];
      Account(search, std::clamp(edge.side, 0, kSides - 1), density, static_cast<int>(c), options,
              edge.IsMovable() ? movable : association);
    }
  }
  JoinMovable(std::move(movable), association);
  return association;
}

void Association::Withdraw(const LandmarkModel& model, int edge, int camera) {
  const auto is_it = [&](const EdgeMatch& m) { return m.edge == edge && (camera < 0 || m.camera == camera); };
  const int side = std::clamp(model.edges[edge].side, 0, kSides - 1);
  for (const EdgeMatch& m : matches) {
    if (!is_it(m)) continue;
    const double importance = std::min(1.0, m.predicted_px / kFullLengthPx);
    log_odds += importance * missed_log_odds - m.log_odds;
    side_found_px[side] -= importance * kFullLengthPx * std::min(1.0, m.covered / kNearlyWhole);
  }
  side_found_px[side] = std::max(0.0, side_found_px[side]);
  std::erase_if(matches, is_it);
}

std::vector<EdgeObservation> Observations(const LandmarkModel& model, const Association& association,
                                          std::span<const CameraView> views,
                                          const Eigen::Isometry3d& base_from_landmark, bool coarse) {
  constexpr double kBeyondPx = 3;
  std::vector<EdgeObservation> observations;
  for (const EdgeMatch& match : association.matches) {
    const CameraView& view = views[match.camera];
    const LandmarkEdge& edge = model.edges[match.edge];
    const auto predicted =
        ProjectEdge(*view.camera, view.size, base_from_landmark * edge.from, base_from_landmark * edge.to);
    if (!predicted) continue;
    const double length = predicted->length_px();
    const Eigen::Vector2d direction = predicted->direction();
    for (const int index : match.lines) {
      const ViewLine& line = view.lines[index];
      const EdgeSegment& segment = view.edges->segments[line.segment];
      if (coarse) {
        const double s = direction.dot(line.p - predicted->p), t = direction.dot(line.q - predicted->p);
        for (const double at : {std::clamp(s, 0.0, length), std::clamp(t, 0.0, length)}) {
          const double f = (at - s) / (t - s);
          observations.push_back({match.edge, match.camera, line.p + f * (line.q - line.p), 0.3});
        }
        continue;
      }
      for (int i = 0; i < segment.n_points; ++i) {
        const EdgePoint& point = view.edges->points[segment.first_point + i];
        const Eigen::Vector2d& at = view.points[segment.first_point + i];
        const double along = direction.dot(at - predicted->p);
        if (along < -kBeyondPx || along > length + kBeyondPx) continue;
        observations.push_back({match.edge, match.camera, at, point.sigma_normal_px});
      }
    }
  }
  return observations;
}

}  // namespace priamos::head
