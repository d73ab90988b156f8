#pragma once

#include "head/core/landmark/edge_association.hpp"

namespace priamos::head {

/// Log odds of what is found, and of what is missed, against clutter alone.
struct Odds {
  double found = 0, missed = 0;
};

/// Log odds of a whole edge at `distance` [px], and of one that is not there; `density` is that of similar
/// edges per pixel.
Odds EdgeOdds(double distance, double density, const AssociationOptions& options);

/// Log odds of the grey values beside an edge: those of the model but for lighting, or, once in a while,
/// those of something before or behind it; against those of any edge. 0 if the model has none.
double GreyOdds(const LandmarkEdge& edge, double measured, const AssociationOptions& options);

/// Log odds of a corner in which both edges end, and of one in which they do not.
Odds CornerOdds(const AssociationOptions& options);

}  // namespace priamos::head
