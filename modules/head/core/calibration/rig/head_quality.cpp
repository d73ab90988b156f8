#include "head/core/calibration/rig/head_quality.hpp"

#include <array>
#include <map>
#include <set>

namespace priamos::head {

namespace {

/// The last exposure of every zoom and focus that has several.
std::set<int> Spared(const std::vector<HeadView>& views) {
  std::map<std::array<int, 4>, std::set<int>> seen;
  for (const HeadView& view : views) {
    const HeadSetting& s = view.setting;
    seen[{s.zoom_step[0], s.zoom_step[1], s.focus_step[0], s.focus_step[1]}].insert(view.exposure);
  }
  std::set<int> spared;
  for (const auto& [setting, exposures] : seen) {
    if (exposures.size() > 1) spared.insert(*exposures.rbegin());
  }
  return spared;
}

/// Sum of the distances between discs and where the camera shows them.
double ErrorOf(const HeadView& view, const CameraModel& camera) {
  double sum = 0;
  for (const DiscObservation& o : view.discs) {
    const Eigen::Vector2d shown =
        camera.Distort(camera.Project(o.disc.centre_m)) + CentroidBias(camera, o.disc);
    sum += (o.centroid_px - shown).norm();
  }
  return sum;
}

}  // namespace

ReconstructionErrors ReconstructObject(const std::vector<HeadView>& views, const HeadModel& head) {
  std::map<int, std::vector<CameraCalibration>> exposures;
  for (const HeadView& view : views) {
    const auto camera = head.CameraAt(view.setting, view.camera);
    if (!camera) continue;
    CameraCalibration& seen = exposures[view.exposure].emplace_back();
    seen.model = *camera;
    seen.observations = view.discs;
  }
  std::vector<SeenPoint> points;
  for (const auto& [exposure, cameras] : exposures) {
    const auto common = CommonPoints(cameras);
    points.insert(points.end(), common.begin(), common.end());
  }
  return Reconstruct(points);
}

Outcome<HeldOutErrors> PredictHeldOut(const std::vector<HeadView>& views, const HeadKnowledge& known) {
  const std::set<int> spared = Spared(views);
  if (spared.empty()) return Refusal{"no zoom and focus was seen more than once"};
  std::vector<HeadView> used, left_out;
  for (const HeadView& view : views) (spared.contains(view.exposure) ? left_out : used).push_back(view);
  const auto solved = SolveHead(used, known);
  if (!solved) return Refusal{solved.reason()};
  HeldOutErrors errors{static_cast<int>(spared.size()), 0};
  std::size_t discs = 0;
  for (const HeadView& view : left_out) {
    const auto camera = solved->model.CameraAt(view.setting, view.camera);
    if (!camera) continue;
    errors.mean_px += ErrorOf(view, *camera);
    discs += view.discs.size();
  }
  if (discs > 0) errors.mean_px /= static_cast<double>(discs);
  return errors;
}

}  // namespace priamos::head
