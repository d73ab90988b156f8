#include "head/see/see_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "head/see/see_landmark.hpp"

namespace priamos::head {

std::string EdgesText(const SeenPhotograph& photograph, const std::string& drawing) {
  const auto is_parallelogram = [](const Polygon& p) { return p.is_parallelogram; };
  std::string text =
      fmt::format("{}: {} segments, {} corners, {} parallelograms, drawn in {}\n", photograph.file,
                  photograph.edges.segments.size(), photograph.contours.corners().size(),
                  std::ranges::count_if(photograph.contours.polygons(), is_parallelogram), drawing);
  if (const auto why = WhyBlind(photograph.edges); !why.empty())
    text += fmt::format("{}: nothing can be seen: {}\n", photograph.file, why);
  return text;
}

std::string MatchesText(std::span<const StereoMatch> matches, const std::string& drawing) {
  return fmt::format("together: {} matches, {} of them with a place in space, drawn in {}\n", matches.size(),
                     CountInSpace(matches), drawing);
}

std::string DoorsText(std::span<const DetectedDoor> doors, const std::string& drawing) {
  std::string text = fmt::format("doors: {}, drawn in {}\n", doors.size(), drawing);
  int number = 0;
  for (const DetectedDoor& door : doors)
    text += fmt::format(
        "  door {}: {:.2f} m ahead, {:.2f} m to the left, {:.1f} deg; {:.2f} m wide, {:.2f} m high, "
        "sigma {:.2f} m\n",
        ++number, door.base_from_door.x, door.base_from_door.y, Degrees(door.base_from_door.yaw),
        door.width_m, door.height_m, std::sqrt(door.covariance.trace()));
  return text;
}

std::string LandmarkText(const std::string& model_file, const FreeModelFix& fix, const std::string& drawing) {
  if (fix.verdict != Verdict::kFound)
    return fmt::format("{}: not found: {}; drawn in {}\n", model_file, Describe(fix.verdict), drawing);
  const auto at = SixFromPose(fix.base_from_model);
  return fmt::format(
      "{}: at {:.4f} {:.4f} {:.4f} m, {:.3f} {:.3f} {:.3f} deg; {} edges, {:.2f} px, drawn in {}\n",
      model_file, at[0], at[1], at[2], at[3], at[4], at[5], fix.n_matched, fix.residual_px, drawing);
}

}  // namespace priamos::head
