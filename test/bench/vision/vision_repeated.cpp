#include <fmt/format.h>

#include <Eigen/Dense>
#include <vector>

#include "robot/core/pose/landmark_update.hpp"
#include "robot/core/pose/pose_state.hpp"
#include "test/bench/vision/door_looks.hpp"
#include "test/bench/vision/landmark_fixes.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {
namespace {

using robot::PoseState;

const Pose2 kMapFromDoor{6, 2.4, 0};

/// A fix with the true pose of the base.
struct TrueFix {
  head::LandmarkFix fix;
  Pose2 map_from_base;
};

/// State of which nothing is known, near `pose`.
PoseState Nowhere(const Pose2& pose) {
  PoseState state;
  state.mean.head<3>() << pose.x + 0.1, pose.y - 0.1, pose.yaw + 0.05;
  state.covariance.topLeftCorner<3, 3>() = Eigen::Vector3d(1, 1, 0.1).asDiagonal();
  return state;
}

/// The way between two looks by an odometry that errs in nothing: whatever the looks have in common shows.
PoseState Driven(PoseState state, const Pose2& from, const Pose2& to) {
  const Pose2 way = from.Inverse() * to;
  const auto second = [](Twist2 twist) {
    return robot::OdometryStep{.from = FromUtime(0), .to = FromUtime(1'000'000), .twist = twist};
  };
  state = robot::Propagated(state, second({way.x, way.y, 0}));
  return robot::Propagated(state, second({0, 0, way.yaw}));
}

PoseState Looked(const PoseState& state, const head::LandmarkFix& fix, bool repeats) {
  const double own_share = repeats ? fix.own_share : 1;
  return robot::Updated(state, {fix.base_from_landmark, fix.covariance, kMapFromDoor, own_share}).state;
}

Eigen::Vector3d Error(const PoseState& state, const Pose2& truth) {
  const Pose2 pose = state.pose();
  return {pose.x - truth.x, pose.y - truth.y, WrapAngle(pose.yaw - truth.yaw)};
}

/// After so many looks, over all doors.
struct Sums {
  int n = 0;
  double nees = 0;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero(), told = squares;

  void Add(const PoseState& state, const Pose2& truth) {
    const Eigen::Vector3d error = Error(state, truth);
    ++n;
    nees += error.dot(state.pose_covariance().inverse() * error) / 3;
    squares += error.cwiseAbs2();
    told += state.pose_covariance().diagonal();
  }
};

void Add(const std::vector<TrueFix>& fixes, bool repeats, std::vector<Sums>& sums) {
  PoseState state = Nowhere(fixes[0].map_from_base);
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    if (i > 0) state = Driven(state, fixes[i - 1].map_from_base, fixes[i].map_from_base);
    state = Looked(state, fixes[i].fix, repeats);
    sums[i].Add(state, fixes[i].map_from_base);
  }
}

void Print(const std::vector<Sums>& sums, bool repeats, Figures& figures) {
  for (const std::size_t looks : {1, 2, 5}) {
    if (looks > sums.size()) break;
    const Sums& s = sums[looks - 1];
    const Eigen::Vector3d error = (s.squares / s.n).cwiseSqrt(), told = (s.told / s.n).cwiseSqrt();
    const std::string name =
        fmt::format("    {} look{}: squared error over covariance", looks, looks > 1 ? "s" : "");
    if (repeats) {
      figures.AtLeast(name, s.nees / s.n, 0.8, "");
      figures.AtMost(name, s.nees / s.n, 1.2, "");
    } else {
      figures.Note(name, s.nees / s.n, "");
    }
    fmt::print(
        "      error {:.2f} mm, {:.2f} mm, {:.3f} degrees; told {:.2f} mm, {:.2f} mm, {:.3f} degrees\n",
        1000 * error.x(), 1000 * error.y(), Degrees(error.z()), 1000 * told.x(), 1000 * told.y(),
        Degrees(told.z()));
  }
}

/// Every door with its own head, calibration and errors of the model; looked at `looks` times, alternating
/// between its sides, from one place or from others.
void Series(const VisionOptions& options, bool moving, int looks, Figures& figures) {
  const int n = options.quick ? 12 : 120;
  fmt::print("{} looks at one door from {}, {} doors, each with its own head and calibration\n", looks,
             moving ? "several places" : "one place", n);
  DoorPhotographer photographer;
  Fixer fixer;
  std::vector<Sums> combined(looks), as_independent(looks);
  int refused = 0;
  double own_share = 0;
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    const CalibratedHead head = CalibrateSpecimen(seed);
    std::vector<TrueFix> fixes;
    for (int k = 0; k < looks; ++k) {
      const LandmarkLook look = photographer.Take(seed, Trouble::kNone, head, {}, 1 + k % 2, moving ? k : 0);
      const head::LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
      if (fix.verdict != head::Verdict::kFound) {
        ++refused;
        continue;
      }
      fixes.push_back({fix, kMapFromDoor * look.truth.Inverse()});
      own_share += fix.own_share / (n * looks);
    }
    if (fixes.empty()) continue;
    Add(fixes, true, combined);
    Add(fixes, false, as_independent);
  }
  fmt::print("  {} looks not found; of the variance {:.3f} is the look's own\n", refused, own_share);
  fmt::print("  as the robot combines them:\n");
  Print(combined, true, figures);
  fmt::print("  as if they had nothing in common:\n");
  Print(as_independent, false, figures);
}

}  // namespace

void BenchRepeated(const VisionOptions& options, Figures& figures) {
  Series(options, false, 2, figures);
  Series(options, true, 5, figures);
}

}  // namespace priamos::bench
