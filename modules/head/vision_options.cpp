#include "head/vision_options.hpp"

namespace priamos::head {

LandmarkFixOptions FinderOptions(const VisionConfig& vision, const HeadModel& head) {
  LandmarkFixOptions options;
  options.solver.model_sigma_m = vision.model_sigma_m;
  options.solver.breadth_sigma_m = vision.breadth_sigma_m;
  options.solver.height_sigma_m = vision.height_sigma_m;
  options.solver.depth_sigma_m = vision.depth_sigma_m;
  options.solver.camera_sigma_px = vision.camera_sigma_px;
  options.solver.base_covariance = head.base_covariance;
  options.stereo.camera_sigma_px = vision.camera_sigma_px;
  options.min_log_odds = vision.min_log_odds;
  options.min_lead = vision.min_lead;
  return options;
}

EdgeOperator::Options EdgeOptions(const VisionConfig& vision) {
  EdgeOperator::Options options;
  options.min_contrast = vision.min_contrast;
  options.usual_grey = vision.usual_grey;
  options.min_length_px = vision.min_edge_px;
  return options;
}

LookOptions EvaluatorOptions(const HeadConfig& config, const HeadModel& head) {
  LookOptions options;
  options.edges = EdgeOptions(config.vision);
  options.finder = FinderOptions(config.vision, head);
  options.drift.model_sigma_m = config.vision.model_sigma_m;
  options.drift.calibration_sigma_px = config.drift.calibration_sigma_px;
  return options;
}

}  // namespace priamos::head
