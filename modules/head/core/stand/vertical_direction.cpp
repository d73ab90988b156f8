#include "head/core/stand/vertical_direction.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "head/core/stand/level_directions.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kPairedEdges = 45;  ///< the longest propose directions
constexpr double kReach = 3;              ///< standard deviations within which an edge agrees
constexpr int kRounds = 8;
constexpr double kTellingShare = 0.1;     ///< of all directions, within which an edge would agree
constexpr double kDifferent = 5;          ///< standard deviations: another direction
constexpr double kDifferent_rad = 0.035;  ///< at least
constexpr std::size_t kFewestEdges = 4;
constexpr int kFewestLevel = 6;        ///< level edges that may say something about uprights
constexpr double kUprightsKept = 0.5;  ///< share of their votes that must still agree

using Votes = std::vector<UprightVote>;

class Election {
 public:
  Election(const Votes& votes, const UprightOptions& options) : votes_(votes), options_(options) {}

  double Sigma(const UprightVote& vote, const Eigen::Vector3d& d) const {
    return std::hypot(vote.Sigma(d), options_.lean_sigma_rad);
  }
  /// Residual in standard deviations.
  double Off(const UprightVote& vote, const Eigen::Vector3d& d) const {
    return std::abs(vote.normal.dot(d)) / Sigma(vote, d);
  }
  /// Weights of the edges that agree with `d`, the less the farther off they are; not of those that agree
  /// with `but` as well.
  double Score(const Eigen::Vector3d& d, const Eigen::Vector3d* but = nullptr) const {
    double sum = 0;
    for (const UprightVote& vote : votes_) {
      const double off = Off(vote, d) / kReach;
      if (off < 1 && !(but && Off(vote, *but) < kReach)) sum += vote.weight * (1 - off * off);
    }
    return sum;
  }

  /// Directions that two of the longest edges have in common.
  std::vector<Eigen::Vector3d> Proposals() const {
    std::vector<Eigen::Vector3d> all;
    const std::size_t n = std::min(votes_.size(), kPairedEdges);
    const double least_down = std::cos(options_.max_slope_rad);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        Eigen::Vector3d d = votes_[i].normal.cross(votes_[j].normal);
        const double sine = d.norm();
        if (sine < 1e-4) continue;
        d /= d.y() > 0 ? -sine : sine;
        if (-d.y() > least_down) all.push_back(d);
      }
    return all;
  }

  VerticalDirection Refined(Eigen::Vector3d d) const {
    VerticalDirection result;
    for (int round = 0; round < kRounds; ++round) {
      const auto step = Step(d, result);
      if (!step) return {};
      d = (d + *step).normalized();
    }
    result.up = d;
    return result;
  }

  /// How often that many edges would agree by chance, whichever direction: natural logarithm. Edges that
  /// point anywhere tell nothing.
  double LogChance(const VerticalDirection& found) const {
    double log_share = 0, all = 0;
    int n = 0;
    for (const UprightVote& vote : votes_) {
      const double share = kReach * Sigma(vote, found.up) / options_.max_slope_rad;
      if (share > kTellingShare) continue;
      ++all;
      if (Off(vote, found.up) > kReach) continue;
      log_share += std::log(share);
      ++n;
    }
    if (n < 3) return 0;
    return std::log(all * (all - 1) / 2) + std::lgamma(all - 1) - std::lgamma(n - 1.0) -
           std::lgamma(all - n + 1) + log_share * (n - 2) / n;
  }

  bool IsAnother(const VerticalDirection& found, const Eigen::Vector3d& d) const {
    const Eigen::Vector3d away = d - found.up;
    if (away.norm() < kDifferent_rad) return false;
    const Eigen::Matrix3d wide =
        found.covariance + (found.up * found.up.transpose() + 1e-8 * Eigen::Matrix3d::Identity());
    return away.dot(wide.ldlt().solve(away)) > kDifferent * kDifferent;
  }

 private:
  /// One step of weighted least squares in the plane across `d`; tells covariance and number of edges.
  std::optional<Eigen::Vector3d> Step(const Eigen::Vector3d& d, VerticalDirection& result) const {
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = d.unitOrthogonal();
    basis.col(1) = d.cross(basis.col(0));
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    double chi2 = 0, weights = 0;
    result.n_edges = 0;
    for (const UprightVote& vote : votes_) {
      const double sigma = Sigma(vote, d), r = vote.normal.dot(d) / sigma;
      if (std::abs(r) > kReach) continue;
      const double share = 1 - r * r / (kReach * kReach), w = share * share;
      const Eigen::Vector2d j = basis.transpose() * vote.normal / sigma;
      information += w * j * j.transpose();
      right -= w * j * r;
      chi2 += w * r * r;
      weights += w;
      ++result.n_edges;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(information);
    if (!(solver.eigenvalues()[0] > 1e-3)) return std::nullopt;
    const Eigen::Matrix2d inverse = information.inverse();
    const double spread = std::max(1.0, chi2 / std::max(1.0, weights - 2));
    result.covariance = basis *
                        (spread * inverse + options_.camera_sigma_rad * options_.camera_sigma_rad *
                                                Eigen::Matrix2d::Identity()) *
                        basis.transpose();
    return basis * (inverse * right);
  }

  const Votes& votes_;
  const UprightOptions& options_;
};

double LargestSigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[2]);
}

/// Fits uprights and level edges together, where there are enough of these and the uprights do not object.
void UseLevelEdges(std::span<const CameraView> views, const Votes& votes, const Election& election,
                   const UprightOptions& options, VerticalDirection& found) {
  const Votes others = OtherEdges(views, options);
  const LevelFrame start{found.up, FindLevelDirections(others, found.up), {}};
  const LevelFrame fitted = FitLevelFrame(votes, others, start, options);
  if (fitted.n_level < kFewestLevel || election.Score(fitted.up) < kUprightsKept * election.Score(found.up))
    return;
  found.up = fitted.up;
  found.covariance = fitted.covariance;
  found.n_edges = fitted.n_upright;
  found.walls = fitted.walls;
}

}  // namespace

const char* Describe(UprightVerdict verdict) {
  switch (verdict) {
    case UprightVerdict::kFound:
      return "found";
    case UprightVerdict::kTooFew:
      return "too few upright edges";
    case UprightVerdict::kAmbiguous:
      return "upright edges agree on two directions";
    case UprightVerdict::kVague:
      break;
  }
  return "upright edges are too short or too near each other";
}

VerticalDirection FindVertical(std::span<const CameraView> views, const UprightOptions& options) {
  const Votes votes = SteepEdges(views, options);
  if (votes.size() < kFewestEdges) return {};
  const Election election(votes, options);
  const std::vector<Eigen::Vector3d> proposals = election.Proposals();
  std::vector<double> scores;
  scores.reserve(proposals.size());
  for (const Eigen::Vector3d& d : proposals) scores.push_back(election.Score(d));
  if (scores.empty()) return {};
  const auto best = std::max_element(scores.begin(), scores.end());
  VerticalDirection found = election.Refined(proposals[best - scores.begin()]);
  if (found.n_edges < static_cast<int>(kFewestEdges) || election.LogChance(found) > options.max_log_chance) {
    VerticalDirection none;
    none.n_edges = found.n_edges;
    return none;
  }
  found.verdict = UprightVerdict::kFound;
  const Eigen::Vector3d elected = found.up;
  UseLevelEdges(views, votes, election, options, found);
  if (!(LargestSigma(found.covariance) < options.max_sigma_rad)) found.verdict = UprightVerdict::kVague;
  const double bound = options.rival_share * election.Score(elected);
  for (std::size_t i = 0; i < proposals.size(); ++i)
    if (scores[i] > bound && election.IsAnother(found, proposals[i]) &&
        election.Score(proposals[i], &found.up) > bound)
      found.verdict = UprightVerdict::kAmbiguous;
  return found;
}

}  // namespace priamos::head
