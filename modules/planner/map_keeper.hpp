#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "planner/core/map/learned_map.hpp"
#include "planner/planner_config.hpp"

namespace priamos::planner {

/// A feature as the map takes it; nullopt when a number is not finite or outside its range.
std::optional<SeenFeature> FromMessage(int store, const feature_t& message);

/// A door as the map takes it; likewise.
std::optional<LearnedDoor> FromMessage(const door_found_t& message);

/// A thing as the map takes it; likewise.
std::optional<LearnedObject> FromMessage(const scene_object_t& message);

/// Which batches of a robot's features came, for FEATURES_ACK.
class BatchLog {
 public:
  /// Notes a batch; returns what is to be said of it.
  features_ack_t Note(int store, int batch);

 private:
  int store_ = 0, newest_ = 0;
  unsigned earlier_ = 0;
};

/// The learned map of a running planner: takes what robots tell, acknowledges it, and keeps it in a file.
class MapKeeper {
 public:
  /// Throws ConfigError when the file is damaged.
  MapKeeper(const PlannerConfig& config, bus::Context& context);
  ~MapKeeper();
  MapKeeper(const MapKeeper&) = delete;
  MapKeeper& operator=(const MapKeeper&) = delete;

  /// Takes messages, and writes the file when it is time. Returns the map when it has changed.
  std::shared_ptr<const LearnedWalls> Tick(Time now);
  /// The features that came since the last call, as they were told.
  std::vector<SeenFeature> TakeTold() { return std::exchange(told_, {}); }
  /// A mission has made the map anew: it is told to whoever listens.
  void Replace(LearnedWalls walls);
  std::shared_ptr<const LearnedWalls> walls() const { return std::make_shared<LearnedWalls>(map_.walls()); }

 private:
  bool TakeFeatures();
  bool TakeDoors();
  bool TakeObjects();
  bool TakeOrders(Time now);
  bool IsToBeWritten() const;
  void Write();

  std::string file_;
  bus::Context& context_;
  double reset_s_ = 0;  ///< since 1970, when the map was forgotten last
  LearnedMap map_;
  int written_ = 0;  ///< revision in the file
  std::optional<Time> wrote_;
  std::vector<SeenFeature> told_;
  bool greeted_ = false, complained_ = false;
  BatchLog batches_;
  bus::Inbox<features_t> features_;
  bus::Inbox<door_found_t> doors_;
  bus::Inbox<scene_object_t> objects_;
  bus::Inbox<map_command_t> orders_;
  bus::Publisher<features_ack_t> acks_;
  bool replaced_ = false;
};

}  // namespace priamos::planner
