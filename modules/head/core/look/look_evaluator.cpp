#include "head/core/look/look_evaluator.hpp"

#include <algorithm>
#include <iterator>

#include "head/core/doors/model_door.hpp"
#include "head/core/look/look_drift.hpp"
#include "head/core/look/usable_image.hpp"

namespace priamos::head {
namespace {

LookResult Without(Verdict verdict) {
  LookResult result;
  result.fix.verdict = verdict;
  return result;
}

}  // namespace

LookEvaluator::LookEvaluator(const HeadModel& head, const LookOptions& options)
    : head_(head),
      leaf_options_(options.leaf),
      drift_options_(options.drift),
      scene_options_(options.scene),
      far_options_(options.far),
      far_sight_(options.far_sight),
      edge_operator_(options.edges),
      finder_(options.finder) {}

/// The third camera, where it is calibrated and its picture is of use; extracts its edges.
std::optional<CameraModel> LookEvaluator::ThirdCamera(const LookInput& input) {
  const auto third = head_.CameraAt(input.setting, kThird);
  if (!third || !IsUsable(input.third)) return std::nullopt;
  edge_operator_.Extract(Wrap(*input.third), edges_[kThird]);
  return *third;
}

/// Extracts the edges of both images; nullopt where one is of no use, or was taken outside of the
/// calibration. `cameras` are those of the views.
std::optional<StereoViews> LookEvaluator::ViewsOf(const LookInput& input,
                                                  std::array<CameraModel, 2>& cameras) {
  if (!std::all_of(input.images.begin(), input.images.end(), IsUsable)) return std::nullopt;
  // Where the motors stand, not where they were sent: counters have steps.
  const auto left = head_.CameraAt(input.setting, kLeft), right = head_.CameraAt(input.setting, kRight);
  if (!left || !right) return std::nullopt;
  cameras = {*left, *right};
  for (int i = 0; i < 2; ++i) edge_operator_.Extract(Wrap(*input.images[i]), edges_[i]);
  return StereoViews{MakeView(cameras[0], edges_[0]), MakeView(cameras[1], edges_[1])};
}

LandmarkFix LookEvaluator::SeeBeyond(const LookInput& input) {
  if (!input.model) return Without(Verdict::kNoModel).fix;
  if (!input.robot) return Without(Verdict::kNoPose).fix;
  std::array<CameraModel, 2> cameras;
  const auto views = ViewsOf(input, cameras);
  if (!views) return Without(Verdict::kNoImage).fix;
  return SeeFar(Beyond(input.model->id), Predict(*input.robot, input.model->map_from_landmark), *views,
                far_sight_);
}

LookResult LookEvaluator::Evaluate(const LookInput& input) {
  if (!input.model) return Without(Verdict::kNoModel);
  if (!input.robot) return Without(Verdict::kNoPose);
  std::array<CameraModel, 2> cameras;
  const auto both = ViewsOf(input, cameras);
  if (!both) return Without(Verdict::kNoImage);
  const StereoViews& views = *both;
  const LandmarkPrediction expected = Predict(*input.robot, input.model->map_from_landmark);
  LookResult result;
  const auto third = ThirdCamera(input);
  std::vector<CameraView> all(views.begin(), views.end());
  if (third) all.push_back(MakeView(*third, edges_[kThird]));
  result.fix = known_[input.model->id].Find(finder_, *input.model, expected, all);
  result.n_third = static_cast<int>(std::ranges::count_if(
      result.fix.matches, [](const EdgeMatch& match) { return match.camera == kThird; }));
  if (result.fix.verdict == Verdict::kFound) {
    if (const auto door = DoorOf(*input.model))
      result.leaf = SeeLeaf(*door, result.fix.base_from_landmark, views, leaf_options_);
  }
  const int camera = CameraToShow(result.fix);
  result.view = ViewLandmark(*input.model, expected, result.fix, views[camera], camera);
  std::vector<StereoMatch> matches = MatchBinocular(views[0], views[1], scene_options_.stereo);
  far_.try_emplace(input.model->id, far_options_).first->second.Learn(result.fix, views[0], matches);
  result.drift = MeasureLookDrift(*input.model, result.fix, views, matches, drift_options_);
  if (third)
    std::ranges::move(MatchTrinocular(views[0], views[1], all[kThird], scene_options_.stereo),
                      std::back_inserter(matches));
  result.scene = ReconstructScene(views, matches, scene_options_, third ? &all[kThird] : nullptr);
  return result;
}

}  // namespace priamos::head
