#pragma once

#include <vector>

#include "common/archive.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/camera/lens_focus.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/pose_history.hpp"
#include "head/core/motion/aim.hpp"

namespace priamos::head {

/// How zoom and focus are chosen for a look.
struct LensChoiceConfig {
  bool choose = false;  ///< off: one setting for all looks
  LensFocus optics;
  double speed_step_s = 800, acceleration_step_s2 = 4000;  ///< of the motors of zoom and focus
  double turn_s = 0.35;         ///< lens motors within the time that turning takes anyway cost nothing
  double driving_look_s = 0.7;  ///< what a look takes while the base drives: a second is worth as much
  double standing_look_s = 3;   ///< while it stands, or time does not matter
  double least_gain = 0.1;      ///< a smaller gain (see ChooseLens) moves no motor

  void Describe(Archive& a);
};

/// What a look is for.
struct LookWish {
  const LandmarkModel& model;
  PoseSample robot;  ///< pose and speed of the base when the head begins to move
  int side = 0;      ///< 0 whole, 1 left, 2 right
};

/// The setting of the head for one look: pan, zoom and focus; all else is that of `fixed`, the setting of a
/// head that does not choose. `here` is where the motors stand.
///
/// A setting tells as much as it keeps edges in both pictures for certain (as AimPan means it, and level
/// edges likewise), times the square of focal length over blur; chosen is the one that tells most per time of
/// the look, motors included; the robot drives on meanwhile. Never chosen is a setting that loses an edge
/// that `fixed` would keep, if there is another one, nor a longer focal length than that of `fixed` unless it
/// keeps the whole landmark. Only calibrated settings are chosen that can be approached from below by
/// `approach_steps`.
HeadSetting ChooseLens(const HeadModel& head, const HeadSetting& fixed, const HeadSetting& here,
                       const LookWish& wish, const AimConfig& aim, const LensChoiceConfig& config,
                       int approach_steps);

/// Which edges of a model a setting keeps in both pictures, for certain; movable ones never.
struct KeptEdges {
  std::vector<bool> edge;  ///< by its index in the model
  bool whole = false;      ///< all upright and level edges that are not movable

  int count() const;
  /// Number of edges that `other` keeps and this one does not.
  int Lost(const KeptEdges& other) const;
};
KeptEdges KeptAt(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                 const LandmarkPrediction& prediction, const AimConfig& aim);

/// Time [s] from one motor position to another one of zoom or focus, arriving from below.
double LensTravel(int from_step, int to_step, int approach_steps, const LensChoiceConfig& config);

}  // namespace priamos::head
