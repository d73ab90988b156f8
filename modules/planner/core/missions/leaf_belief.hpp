#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// Where the leaf of a door stands.
struct LeafEstimate {
  std::string hinge;     ///< "left" or "right"
  double open_rad = 0;   ///< 0 is closed
  double sigma_rad = 0;  ///< sigma of that angle
};

/// What all looks at a door together say about its leaf. It is known when two looks or more agree, and their
/// evidence outweighs that of those which saw it elsewhere or not at all.
class LeafBelief {
 public:
  void Reset() { sightings_.clear(); }
  void Add(const LeafSighting& sighting) { sightings_.push_back(sighting); }
  /// The leaf; nullopt: not known.
  std::optional<LeafEstimate> Estimate() const;

 private:
  std::vector<LeafSighting> sightings_;
};

}  // namespace priamos::planner
