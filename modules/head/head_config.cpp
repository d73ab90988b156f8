#include "head/head_config.hpp"

#include "common/geometry.hpp"

namespace priamos::head {

void VisionConfig::Describe(Archive& a) {
  a.Number("min_contrast", min_contrast,
           {"-", 1, 100, "weakest edge that is used in a well exposed picture [grey values]"});
  a.Number("usual_grey", usual_grey,
           {"-", 0, 255, "mean grey value of such a picture; in darker ones weaker edges are used"});
  a.Number("min_edge_px", min_edge_px, {"px", 8, 200, "shortest edge that is used"});
  a.Number("model_sigma_m", model_sigma_m,
           {"m", 0.0001, 0.05, "how well landmark models are known, each edge and axis"});
  a.Number("breadth_sigma_m", breadth_sigma_m,
           {"m", 0, 0.05, "how well the breadth of landmarks is known: a door's width, with a tape"});
  a.Number("height_sigma_m", height_sigma_m, {"m", 0, 0.05, "and their height"});
  a.Number("depth_sigma_m", depth_sigma_m,
           {"m", 0, 0.05, "and how far their faces stand out from the wall, all edges of a face together"});
  a.Number("camera_sigma_px", camera_sigma_px, {"px", 0.01, 5, "how well the cameras are calibrated"});
  a.Number("min_log_odds", min_log_odds,
           {"-", 0, 100, "natural logarithm of the evidence that a fix needs beyond chance"});
  a.Number("min_lead", min_lead, {"-", 0, 100, "and over the next best pose"});
  a.Flag("third_camera", third_camera, "the third camera takes part in looks, where it is calibrated");
}

void ReferencePose::Describe(Archive& a) {
  a.Text("object", object, "its discs, relative to this file");
  a.Number("x_m", x_m, {"m", -10, 10, "its origin in the base frame"});
  a.Number("y_m", y_m, {"m", -10, 10, "its origin in the base frame"});
  a.Number("z_m", z_m, {"m", -1, 5, "its origin in the base frame"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "direction of its x axis, which points out of its front"});
  a.Number("error_m", error_m, {"m", 0, 0.1, "how exactly it stands there: 1 sigma of each coordinate"});
  a.Number("error_deg", error_deg, {"deg", 0, 10, "and of the turn about each axis"});
}

void HeadConfig::Describe(Archive& a) {
  a.Number("rate_hz", rate_hz, {"Hz", 10, 200, "decisions"});
  a.Choice("mode", mode, {"look", "calibrate"},
           "look answers LOOK_REQUEST; calibrate observes the reference object, writes the table and ends");
  a.Text("calibration", calibration, "table of calibrated head setups, relative to this file");
  a.Text("pictures", pictures,
         "folder with the pictures of a log that is played, relative to this file; empty: the cameras");
  a.Text("keep_pictures", keep_pictures,
         "folder in which every picture that is used is kept, relative to this file; empty: none is");
  a.Number("tilt_deg", tilt_deg,
           {"deg", -45, 45, "tilt for all looks, positive looks down; farther up as look_up says"});
  a.Number("convergence_deg", convergence_deg,
           {"deg", -20, 20, "each camera is turned so far towards the middle"});
  a.Integer("zoom_step", zoom_step, {"step", 0, 2000, "zoom motors for all looks that do not choose it"});
  a.Integer("focus_step", focus_step, {"step", 0, 2000, "focus motors likewise"});
  a.Section("aim", aim, "where the head looks");
  a.Section("look_up", look_up, "how far a look is tilted up, so that the lintel is in the pictures");
  a.Section("lens", lens, "zoom and focus of each look");
  a.Section("reference", reference, "where the reference object stands during a calibration");
  a.Section("plan", plan, "the settings a calibration visits");
  a.Section("drawing", drawing, "the head as drawn: where a calibration starts");
  a.Section("motors", motors, "the KASTOR motors");
  a.Section("look", look, "the course of one look");
  a.Section("follow", follow, "looks that nobody orders, at what was found from near");
  a.Section("vision", vision, "edges and landmark fixes");
  a.Section("drift", drift, "alarm when the cameras are no longer where the calibration has them");
  a.Section("laser", laser, "obstacles and steps by the laser's line");
  a.Section("doors", doors, "glances aside, for doors that are not looked at by order");
  a.Section("scene", scene, "glances ahead, for what stands on the floor");
  a.Section("video", video, "the third camera's pictures for people, over HTTP beside the bus");
  if (!pictures.empty() && !keep_pictures.empty())
    a.Refuse("keep_pictures", "no folder beside `pictures`: those are kept already");
  using enum LiveChange;
  a.Live("aim.side_share", kInRange);
  a.Live("aim.lead_s", kInRange);
  a.Live("aim.max_pan_deg", kOnlyLower);
  a.Live("look.frame_timeout_s", kInRange);
  a.Live("look.age_limit_s", kInRange);
  a.Live("motors.settle_s", kOnlyHigher);
  a.Live("motors.timeout_s", kInRange);
  // Nearer to the end stop a motor cannot come from below.
  const int nearest = motors.approach_steps;
  if (zoom_step < nearest || plan.zoom.first < nearest)
    a.Refuse("zoom_step", "zoom not below motors.approach_steps");
  if (doors.zoom_step < nearest) a.Refuse("doors.zoom_step", "zoom not below motors.approach_steps");
  if (focus_step < nearest || plan.focus.first < nearest)
    a.Refuse("focus_step", "focus not below motors.approach_steps");
}

HeadSetting HeadConfig::LookSetting() const {
  const double turn = Radians(convergence_deg);
  return {0, Radians(tilt_deg), {-turn, turn}, {zoom_step, zoom_step}, {focus_step, focus_step}};
}

HeadSetting HeadConfig::WatchSetting() const {
  HeadSetting setting = LookSetting();
  setting.tilt_rad = Radians(laser.tilt_deg);
  return setting;
}

}  // namespace priamos::head
