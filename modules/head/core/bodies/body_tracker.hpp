#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "head/core/bodies/free_model_fix.hpp"

namespace priamos::head {

/// How a body is followed from moment to moment.
struct BodyTrackerOptions {
  FreeModelOptions fix{};  ///< its prior is that of the start
  /// How far the body may have moved from one moment to the next against the cameras, one sigma along and
  /// about each axis: a share of the distance, and an angle.
  double motion_share = 0.035, motion_rad = 0.03;
  /// FreeModelOptions::min_agreement* and min_evidence of a body that was found in the moment before: it is
  /// the right one, and no other body of its kind takes its place from one moment to the next.
  double min_agreement_when_followed = 1, min_evidence_when_followed = 3.1;
  double max_growth = 4;  ///< so many times wider at most does the search become while the body is lost
};

/// Follows a body through the images of a sequence. It is looked for where it was last and, while it is lost,
/// also where it was in the beginning, each time by LocateFreeModel, whose evidence every single fix needs:
/// what is lost is never made up. A guess of its motion from two fixes was worse than none: their noise, as
/// large as the motion, led to wrong edges.
class BodyTracker {
 public:
  BodyTracker(Polyhedron body, const Eigen::Isometry3d& start, const BodyTrackerOptions& options)
      : body_(std::move(body)), start_(start), options_(options) {}

  /// The body in the images of one moment: at the first belief that they confirm, or why they deny all.
  FreeModelFix Look(std::span<const CameraView> views);

  /// Where it was looked for first in the last images.
  const Eigen::Isometry3d& believed() const { return believed_; }
  /// Moments since it was seen last; those since the beginning if it never was.
  int n_lost() const { return n_lost_; }

 private:
  struct Belief {
    Eigen::Isometry3d base_from_model;
    double share, rad;
    bool is_followed;  ///< found there in the moment before
  };
  std::vector<Belief> Beliefs() const;

  Polyhedron body_;
  Eigen::Isometry3d start_;
  BodyTrackerOptions options_;
  std::optional<Eigen::Isometry3d> last_;
  Eigen::Isometry3d believed_ = start_;
  int n_lost_ = 0;
};

}  // namespace priamos::head
