#pragma once

#include <map>
#include <vector>

#include "planner/core/map/seen_feature.hpp"

namespace priamos::planner {

/// Under which names robots told the points of a map. A point that is told again is moved to where it is by
/// then; one that nobody named so far is that which lies there already, or one more.
class PointBook {
 public:
  void Take(const FeatureName& name, const LearnedPoint& told, std::vector<LearnedPoint>& points);
  /// Takes the point of that name off the map. Returns whether there was one.
  bool Forget(const FeatureName& name, std::vector<LearnedPoint>& points);
  void Clear() { ids_.clear(); }

 private:
  bool IsShared(int id) const;
  void ForgetDropped(const std::vector<LearnedPoint>& points);
  void Join(int id, std::vector<LearnedPoint>& points);

  std::map<FeatureName, int> ids_;  ///< of the point that a name is, or is one of several of
};

}  // namespace priamos::planner
