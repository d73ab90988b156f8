#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "head/core/edge_segments.hpp"
#include "head/core/landmark_fix.hpp"
#include "head/vision_options.hpp"
#include "test/bench/door_looks.hpp"
#include "test/bench/vision_bench.hpp"
#ifdef PRIAMOS_HAS_VISP
#include "test/bench/visp_door.hpp"
#endif

namespace priamos::bench {
namespace {

using head::LandmarkFix, head::Verdict;

const Eigen::Matrix3d kBelief = Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();

/// Error of a pose of the landmark in the base frame, seen along the door: depth, lateral, heading.
Eigen::Vector3d ErrorOf(const Pose2& found, const Pose2& truth) {
  return {found.x - truth.x, found.y - truth.y, WrapAngle(found.yaw - truth.yaw)};
}

bool IsGood(const Eigen::Vector3d& error) {
  return error.head<2>().norm() < 0.03 && std::abs(error.z()) < Radians(1);
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 1e9;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * values.size()))];
}

/// How a series of fixes fared.
struct Series {
  int looks = 0, good = 0, wrong = 0;
  std::map<std::string, int> refusals;
  std::vector<double> depth, lateral, yaw, nees, seconds;

  void Add(const Eigen::Vector3d& error, double seconds_taken) {
    const bool is_good = IsGood(error);
    (is_good ? good : wrong)++;
    if (!is_good) return;
    depth.push_back(1000 * std::abs(error.x())), lateral.push_back(1000 * std::abs(error.y()));
    yaw.push_back(Degrees(std::abs(error.z())));
    seconds.push_back(seconds_taken);
  }
  double MeanNees() const {
    double sum = 0;
    for (const double n : nees) sum += n;
    return nees.empty() ? 0 : sum / nees.size();
  }
};

/// As priamos-head tells its finder, with this head's calibration.
head::LandmarkFixOptions Told(const DoorLook& look) {
  head::HeadModel head;
  head.base_covariance = look.base_covariance;
  return head::FinderOptions(head::VisionConfig(), head);
}

struct Fixer {
  head::EdgeOperator edge_operator;
  std::array<head::EdgeImage, 2> edges;
  double seconds = 0;

  LandmarkFix Find(const DoorLook& look, const head::LandmarkFixOptions& options,
                   const head::LandmarkModel& model, const std::array<head::CameraModel, 2>& cameras) {
    const double start = CpuSeconds();
    for (int c = 0; c < 2; ++c) edge_operator.Extract(look.images[c], edges[c]);
    const LandmarkFix fix = head::LandmarkFinder(options).Find(model, {look.believed, kBelief}, cameras[0],
                                                               cameras[1], edges[0], edges[1]);
    seconds = CpuSeconds() - start;
    return fix;
  }
};

/// How far the edges of an image really lie beside a model without errors in exact cameras.
void AddEdgeNoise(const Fixer& fixer, const DoorLook& look, std::vector<double>& distances) {
  const std::array<head::CameraView, 2> views{head::MakeView(look.exact[0], fixer.edges[0]),
                                              head::MakeView(look.exact[1], fixer.edges[1])};
  std::vector<int> visible;
  const Eigen::Vector2d viewer = look.truth.Inverse().translation();
  for (std::size_t i = 0; i < look.exact_model.edges.size(); ++i)
    if (look.exact_model.edges[i].IsSeenFrom(viewer)) visible.push_back(static_cast<int>(i));
  const auto found = head::Associate(look.exact_model, visible, views, head::Lift(look.truth), {});
  for (const head::EdgeMatch& m : found.matches) distances.push_back(std::abs(m.distance_px));
}

/// Fixes with exact cameras and model: what is left is the noise of edges. Its Cramer-Rao bound is that of
/// the edges' measured noise (1.48 times the median distance) and the geometry of the edges that were used.
void OverCramerRao(const std::vector<DoorLook>& looks, Figures& figures) {
  Fixer fixer;
  head::LandmarkFixOptions options;
  options.solver.model_sigma_m = options.solver.tilt_sigma_m = 1e-6;
  options.solver.camera_sigma_px = 1e-4;
  std::vector<LandmarkFix> fixes;
  std::vector<double> noise;
  for (const DoorLook& look : looks) {
    fixes.push_back(fixer.Find(look, options, look.exact_model, look.exact));
    AddEdgeNoise(fixer, look, noise);
  }
  const double sigma_px = 1.4826 * Quantile(noise, 0.5);
  // All weights are equal but for the operator's own part, which is far smaller: the bound goes with the
  // noise.
  const double scale = sigma_px / options.solver.edge_sigma_px;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero(), bound = Eigen::Vector3d::Zero();
  std::vector<double> ratios;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Eigen::Vector3d error = ErrorOf(fixes[i].base_from_landmark, looks[i].truth);
    if (fixes[i].verdict != Verdict::kFound || !IsGood(error)) continue;
    squares += error.cwiseAbs2(), bound += scale * scale * fixes[i].covariance.diagonal();
    ratios.push_back(std::sqrt(error.dot(fixes[i].covariance.inverse() * error) / 3) / scale);
  }
  figures.Note("  noise of a whole edge, cameras and model exact", sigma_px, "px");
  const double n = static_cast<double>(ratios.size());
  const Eigen::Vector3d rms = (squares / n).cwiseSqrt();
  fmt::print(
      "  exact cameras and model: {:.2f} mm depth, {:.2f} mm lateral, {:.4f} degrees root mean square\n",
      1000 * rms.x(), 1000 * rms.y(), Degrees(rms.z()));
  figures.AtMost("  error over Cramer-Rao bound, depth", rms.x() / std::sqrt(bound.x() / n), 1.5, "");
  figures.AtMost("  error over Cramer-Rao bound, lateral", rms.y() / std::sqrt(bound.y() / n), 1.5, "");
  figures.AtMost("  error over Cramer-Rao bound, heading", rms.z() / std::sqrt(bound.z() / n), 1.5, "");
  figures.Note("  error over Cramer-Rao bound, all three, median look", Quantile(ratios, 0.5), "");
}

void Report(const Series& s, Figures& figures) {
  for (const auto& [why, n] : s.refusals) fmt::print("  refused, {}: {}\n", why, n);
  figures.AtLeast("  within 3 cm and 1 degree, of 60", 60.0 * s.good / s.looks, 59, "");
  figures.AtMost("  silent wrong fixes", s.wrong, 0, "");
  figures.AtMost("  lateral error, median", Quantile(s.lateral, 0.5), 2, "mm");
  figures.AtMost("  lateral error, 95 %", Quantile(s.lateral, 0.95), 6, "mm");
  figures.AtMost("  depth error, median", Quantile(s.depth, 0.5), 2, "mm");
  figures.AtMost("  depth error, 95 %", Quantile(s.depth, 0.95), 6, "mm");
  figures.AtMost("  heading error, median", Quantile(s.yaw, 0.5), 0.05, "deg");
  figures.AtMost("  heading error, 95 %", Quantile(s.yaw, 0.95), 0.15, "deg");
  figures.AtLeast("  squared error over covariance, per degree of freedom", s.MeanNees(), 0.8, "");
  figures.AtMost("  squared error over covariance, per degree of freedom", s.MeanNees(), 1.2, "");
  figures.AtMost("  time per stereo pair, edges included", 1000 * Quantile(s.seconds, 0.5), 8, "ms");
}

/// Whole looks at the door, each with another specimen of the head, calibrated by itself.
void Looks(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 12 : 120;
  fmt::print("door from +-20 cm and +-5 degrees at 2.4 m, {} looks, each with its own head and calibration\n",
             n);
  DoorPhotographer photographer;
  Fixer fixer;
  Series series;
  std::vector<DoorLook> looks;
#ifdef PRIAMOS_HAS_VISP
  Series stereo, mono;
#endif
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = options.seed + i;
    const DoorLook look = photographer.Take(seed, Trouble::kNone, CalibrateSpecimen(seed));
    ++series.looks;
    const LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
    if (fix.verdict != Verdict::kFound) {
      ++series.refusals[head::Describe(fix.verdict)];
      if (options.verbose) fmt::print("  seed {}: {}\n", seed, head::Describe(fix.verdict));
    } else {
      const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
      series.Add(error, fixer.seconds);
      series.nees.push_back(error.dot(fix.covariance.inverse() * error) / 3);
      if (options.verbose) {
        const Eigen::Vector3d s = fix.covariance.diagonal().cwiseSqrt();
        fmt::print(
            "  seed {}: {:.2f} {:.2f} mm {:.3f} deg, sigma {:.2f} {:.2f} {:.3f}, nees {:.2f}, misfit {:.2f}, "
            "{} edges, {:.1f} ms\n",
            seed, 1000 * error.x(), 1000 * error.y(), Degrees(error.z()), 1000 * s.x(), 1000 * s.y(),
            Degrees(s.z()), series.nees.back(), fix.misfit, fix.n_matched, 1000 * fixer.seconds);
      }
    }
    looks.push_back(look);
#ifdef PRIAMOS_HAS_VISP
    for (const bool both : {true, false}) {
      Series& rival = both ? stereo : mono;
      ++rival.looks;
      const VispFix fix = FixWithVisp(look, both);
      if (fix.ok) rival.Add(ErrorOf(fix.base_from_landmark, look.truth), fix.seconds);
      if (!fix.ok) ++rival.refusals["lost"];
    }
#endif
  }
  Report(series, figures);
  OverCramerRao(looks, figures);
#ifdef PRIAMOS_HAS_VISP
  for (const auto& [name, rival] : {std::pair{"stereo", &stereo}, std::pair{"left image only", &mono}})
    fmt::print(
        "  ViSP edge tracker, {}: {} of {} good, {} silently wrong, median {:.1f} mm lateral, {:.1f} mm "
        "depth, "
        "{:.2f} degrees, {:.1f} ms\n",
        name, rival->good, rival->looks, rival->wrong, Quantile(rival->lateral, 0.5),
        Quantile(rival->depth, 0.5), Quantile(rival->yaw, 0.5), 1000 * Quantile(rival->seconds, 0.5));
#endif
}

/// Scenes made to deceive: the answer may be "not found", never a wrong pose.
void Deceptions(const VisionOptions& options, Figures& figures) {
  const int n = options.quick ? 20 : 200;
  fmt::print("scenes that deceive: {} of each kind\n", n);
  DoorPhotographer photographer;
  Fixer fixer;
  const CalibratedHead head = CalibrateSpecimen(1);
  int wrong = 0;
  for (const Trouble trouble : kTroubles) {
    Series series;
    for (int i = 0; i < n; ++i) {
      const std::uint64_t seed = options.seed + 100000 * static_cast<int>(trouble) + i;
      const DoorLook look = photographer.Take(seed, trouble, head);
      const LandmarkFix fix = fixer.Find(look, Told(look), look.model, look.calibrated);
      ++series.looks;
      if (fix.verdict != Verdict::kFound) {
        ++series.refusals[head::Describe(fix.verdict)];
        continue;
      }
      const Eigen::Vector3d error = ErrorOf(fix.base_from_landmark, look.truth);
      const bool right = look.door_is_there && IsGood(error);
      (right ? series.good : series.wrong)++;
      if (!right)
        fmt::print(
            "  {}, seed {}: wrong by {:.0f} mm, {:.0f} mm, {:.2f} deg; log odds {:.1f}, rival {:.1f}, misfit "
            "{:.2f}, {} edges\n",
            Describe(trouble), seed, 1000 * error.x(), 1000 * error.y(), Degrees(error.z()), fix.log_odds,
            fix.rival_log_odds, fix.misfit, fix.n_matched);
    }
    fmt::print("  {}: {} right, {} wrong, {} refused\n", Describe(trouble), series.good, series.wrong,
               series.looks - series.good - series.wrong);
    for (const auto& [why, count] : series.refusals) fmt::print("    {}: {}\n", why, count);
    wrong += series.wrong;
  }
  figures.AtMost("  silent wrong fixes", wrong, 0, "");
}

}  // namespace

void BenchDoor(const VisionOptions& options, Figures& figures) {
  Looks(options, figures);
}

void BenchDeceptions(const VisionOptions& options, Figures& figures) {
  Deceptions(options, figures);
}

}  // namespace priamos::bench
