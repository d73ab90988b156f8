#pragma once

#include <map>
#include <optional>

#include "head/core/doors/door_tracks.hpp"

namespace priamos::head {

/// How often doors are told.
struct DoorNewsOptions {
  double every_s = 5;       ///< between two messages: what the radio carries
  double moved_m = 0.03;    ///< a door that is farther from where it was told is news
  double told_for_s = 600;  ///< a door that was not seen for longest is not told again
};

/// Which door is told next: one that is new or has changed, else the one that was told longest ago, so that
/// a message that the radio loses is made up for.
class DoorNews {
 public:
  explicit DoorNews(const DoorNewsOptions& options = {}) : options_(options) {}

  /// The door to tell now; nullopt: none, or it is not time yet.
  std::optional<DoorTrack> Next(const DoorTracks& doors, Time now);
  /// What was told belongs to doors that are forgotten.
  void Forget() { told_.clear(); }

 private:
  struct Told {
    Time at{};
    Eigen::Vector2d place;
    DoorState state = DoorState::kUnknown;
  };
  bool IsNews(const DoorTracks& doors, const DoorTrack& track) const;

  DoorNewsOptions options_;
  std::map<int, Told> told_;  ///< by the door's number
  std::optional<Time> last_;
};

}  // namespace priamos::head
