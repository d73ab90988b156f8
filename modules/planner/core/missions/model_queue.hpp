#pragma once

#include <deque>
#include <map>
#include <optional>

#include "common/time.hpp"
#include "planner/core/map/landmark.hpp"

namespace priamos::planner {

/// Which model of a landmark the head is sent next. The radio carries one in `period`, in the order in which
/// they were given to it, while looks ask for them faster: without this, the model of the door ahead would
/// wait behind those of doors that were passed long ago. The newest wish goes first, an old one is dropped,
/// and a model that is on its way is not sent once more.
class ModelQueue {
 public:
  explicit ModelQueue(Duration period) : period_(period) {}

  /// Notes that the head needs this model.
  void Want(Landmark model, Time now);
  /// The model to be sent now, each period at most; nullopt: none.
  std::optional<Landmark> Next(Time now);

 private:
  struct Wish {
    Landmark model;
    Time since{};
  };
  bool IsOnItsWay(int id, Time now) const;

  Duration period_;
  std::deque<Wish> newest_first_;
  std::map<int, Time> sent_;
  std::optional<Time> last_;
};

}  // namespace priamos::planner
