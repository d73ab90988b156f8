#pragma once

#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// Which image edge may belong to which model edge, and the statistics that give the odds.
struct AssociationOptions {
  double sigma_px = 0.5;  ///< expected distance of an image edge from the right prediction
  double gate_px = 1.5;   ///< image edges farther from the prediction do not belong to it
  double max_angle_rad = 0.05;
  double detection = 0.85;  ///< chance that the operator finds an edge that is there
  double clutter_window_px =
      40;  ///< half width of the strip in which the density of similar edges is measured
  double min_covered = 0.15;
  double min_separation_px = 5;  ///< model edges seen nearer to each other are left out, both
  double grey_sigma = 0.35;      ///< measured minus modelled grey_ratio: lighting
  double any_grey_sigma = 0.7;   ///< measured grey_ratio of any edge, about 0
  double grey_surprise = 0.1;    ///< share of edges beside which there is something else
  double free_overshoot_px =
      6;  ///< an edge may run on so far where the model's ends: ends are not found better than that
  double corner_px = 6;  ///< edges that end so near to a corner end in it
  /// Share of corners in which both edges end: 0.62 were measured of doors, 0.11 of cupboards, whose edges
  /// get lost in their own shadow; and where there is no corner (0.06, 0).
  double corner_detection = 0.4, corner_chance = 0.06;
};

/// Log odds, landmark against clutter, of an edge or corner that was found and of one that was not.
struct Odds {
  double found = 0, missed = 0;
};

/// Log odds of a whole edge at `distance` [px] from its prediction, and of one that is not there. `density`
/// is the number of similar edges per pixel beside the prediction.
Odds EdgeOdds(double distance, double density, const AssociationOptions& options);

/// Log odds of the grey values beside an edge, `measured` as EdgeMatch::grey_ratio: those of the model but
/// for lighting, or, once in a while, those of something before or behind it; against those of any edge. 0 if
/// the model has none.
double GreyOdds(const LandmarkEdge& edge, double measured, const AssociationOptions& options);

/// Log odds of a corner in which both edges end, and of one in which they do not.
Odds CornerOdds(const AssociationOptions& options);

}  // namespace priamos::head
