#include "head/core/bodies/body_proposals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry.hpp"
#include "head/core/camera/projection.hpp"
#include "head/core/landmark/edge_field.hpp"

namespace priamos::head {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kNear = 0.05;            ///< edges nearer to the camera are not compared [depth]
constexpr double kUsefulLength_px = 150;  ///< a longer edge counts no more than that
constexpr double kSigmas = 2.6;           ///< of the prior: so far the images are looked at

/// A motion of the body against the belief in standard deviations of the prior: a shift along the axes of
/// base, then a turn about the middle of the body.
class Motions {
 public:
  Motions(const Eigen::Isometry3d& believed, const Eigen::Vector3d& middle_in_model, const BodyPrior& prior)
      : believed_(believed), middle_(believed * middle_in_model), prior_(prior) {}

  Eigen::Isometry3d At(const Vector6& motion) const {
    const Eigen::Vector3d turn = prior_.sigma_rad * motion.tail<3>();
    const double angle = turn.norm();
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    if (angle > 0) moved.linear() = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
    moved.translation() = middle_ + prior_.sigma_m * motion.head<3>() - moved.linear() * middle_;
    return moved * believed_;
  }

 private:
  const Eigen::Isometry3d believed_;
  const Eigen::Vector3d middle_;
  const BodyPrior prior_;
};

/// The k-th point of a low-discrepancy sequence in six dimensions (Roberts 2018), as six normal deviates.
Vector6 NormalPoint(int k) {
  constexpr double kRatio = 1.1347241384015194;  // x^7 = x + 1
  Vector6 uniform;
  double step = 1;
  for (double& u : uniform) {
    step /= kRatio;
    const double along = 0.5 + (k + 1) * step;
    u = along - std::floor(along);
  }
  Vector6 normal;
  for (int i = 0; i < 6; i += 2) {  // Box and Muller
    const double radius = std::sqrt(-2 * std::log(std::max(uniform[i], 1e-9)));
    normal[i] = radius * std::cos(2 * kPi * uniform[i + 1]);
    normal[i + 1] = radius * std::sin(2 * kPi * uniform[i + 1]);
  }
  return normal;
}

/// One image with its field of edges.
struct Field {
  const CameraModel* camera;
  EdgeField edges;
};

/// The part of the image in which the body may be.
FieldRegion RegionOf(const LandmarkModel& seen, const Eigen::Isometry3d& at, const CameraView& view,
                     const BodyPrior& prior) {
  FieldRegion region{{1e9, 1e9}, {-1e9, -1e9}};
  double depth = 1e9;
  for (const LandmarkEdge& edge : seen.edges) {
    for (const Eigen::Vector3d& end : {edge.from, edge.to}) {
      const Eigen::Vector3d in_base = at * end;
      if (view.camera->Depth(in_base) < kNear) continue;
      depth = std::min(depth, view.camera->Depth(in_base));
      const Eigen::Vector2d p = view.camera->Project(in_base);
      region.from = region.from.cwiseMin(p);
      region.to = region.to.cwiseMax(p);
    }
  }
  const double focal_px = view.camera->image_from_base.block<1, 3>(1, 0).norm();
  const double extent_px = (region.to - region.from).norm();
  const double margin_px = kSigmas * (focal_px * prior.sigma_m / depth + extent_px / 2 * prior.sigma_rad);
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(std::min(margin_px, 2000.0));
  region.from = (region.from - margin).cwiseMax(Eigen::Vector2d(-20, -20));
  region.to = (region.to + margin).cwiseMin(Eigen::Vector2d(view.size.width + 20, view.size.height + 20));
  return region;
}

std::vector<Field> FieldsOf(const LandmarkModel& seen, const Eigen::Isometry3d& at,
                            std::span<const CameraView> views, const BodyPrior& prior, double sigma_px) {
  std::vector<Field> fields;
  for (const CameraView& view : views)
    fields.push_back({view.camera, EdgeField(view, RegionOf(seen, at, view, prior), sigma_px)});
  return fields;
}

/// How well a pose explains the images: length-weighted mean over the edges of what is beside them, beyond
/// chance.
double Score(const LandmarkModel& seen, const std::vector<Field>& fields, const Eigen::Isometry3d& at) {
  double sum = 0, weight = 0;
  for (const Field& field : fields) {
    const Eigen::Matrix<double, 3, 4> image_from_model = field.camera->image_from_base * at.matrix();
    for (const LandmarkEdge& edge : seen.edges) {
      const Eigen::Vector3d a = image_from_model * edge.from.homogeneous();
      const Eigen::Vector3d b = image_from_model * edge.to.homogeneous();
      if (a.z() < kNear || b.z() < kNear) continue;
      const Eigen::Vector2d p = a.head<2>() / a.z(), q = b.head<2>() / b.z();
      const double length = std::min((q - p).norm(), kUsefulLength_px);
      if (length < 4) continue;
      sum += length * field.edges.Along(p, q);
      weight += length;
    }
  }
  return weight > 0 ? sum / weight : 0;
}

struct Candidate {
  Vector6 motion;
  double score;
};

bool IsBetter(const Candidate& a, const Candidate& b) {
  return a.score > b.score;
}

/// Without those that lie near to a better one.
void KeepDifferent(std::vector<Candidate>& candidates, double nearest, int n) {
  std::stable_sort(candidates.begin(), candidates.end(), IsBetter);
  std::vector<Candidate> kept;
  for (const Candidate& c : candidates) {
    if (static_cast<int>(kept.size()) == n) break;
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Candidate& k) { return (k.motion - c.motion).norm() < nearest; }))
      kept.push_back(c);
  }
  candidates = std::move(kept);
}

/// Pattern search (Hooke and Jeeves): along each coordinate as long as it improves, then in half the steps.
template <typename F>
void Climb(const F& score, double step, int n_halved, Candidate& candidate) {
  candidate.score = score(candidate.motion);
  for (int level = 0; level <= n_halved; ++level, step /= 2) {
    for (int sweep = 0; sweep < 3; ++sweep) {
      const double before = candidate.score;
      for (int i = 0; i < 6; ++i) {
        for (const double sign : {1.0, -1.0}) {
          Candidate tried = candidate;
          tried.motion[i] += sign * step;
          tried.score = score(tried.motion);
          if (tried.score <= candidate.score) continue;
          candidate = tried;
          break;
        }
      }
      if (candidate.score <= before) break;
    }
  }
}

}  // namespace

Eigen::Vector3d MiddleOf(const LandmarkModel& model) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const LandmarkEdge& edge : model.edges) sum += (edge.from + edge.to) / 2;
  return sum / static_cast<double>(std::max<std::size_t>(1, model.edges.size()));
}

std::vector<Eigen::Isometry3d> ProposeBodyPoses(const LandmarkModel& seen, const Eigen::Isometry3d& believed,
                                                std::span<const CameraView> views, const BodyPrior& prior,
                                                const BodyProposalOptions& options) {
  const Motions motions(believed, MiddleOf(seen), prior);
  const auto coarse = FieldsOf(seen, believed, views, prior, options.sigma_px);
  std::vector<Candidate> candidates{{Vector6::Zero(), Score(seen, coarse, believed)}};
  for (int k = 0; k < options.n_poses; ++k) {
    const Vector6 motion = NormalPoint(k);
    candidates.push_back({motion, Score(seen, coarse, motions.At(motion))});
  }
  KeepDifferent(candidates, 0.3, options.n_climbed);
  const auto fine = FieldsOf(seen, believed, views, prior, options.fine_sigma_px);
  for (Candidate& candidate : candidates) {
    Climb([&](const Vector6& m) { return Score(seen, coarse, motions.At(m)); }, 0.3, 1, candidate);
    Climb([&](const Vector6& m) { return Score(seen, fine, motions.At(m)); }, 0.12, 1, candidate);
  }
  KeepDifferent(candidates, 0.15, options.n_best);
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(candidates.size());
  for (const Candidate& c : candidates) poses.push_back(motions.At(c.motion));
  return poses;
}

}  // namespace priamos::head
