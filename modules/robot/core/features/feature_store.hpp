#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "robot/core/features/feature.hpp"

namespace priamos::robot {

/// How many features are kept, and when they are told again.
struct FeatureStoreConfig {
  int most = 200;           ///< features; of more the oldest that was told goes first
  double period_s = 4;      ///< between two batches
  double repeat_s = 15;     ///< a batch that is not acknowledged by then is told again
  double grown_m = 1.0;     ///< a wall that grew so much is told again
  double moved_m = 0.04;    ///< so is one whose middle, or a point, is so far beside what was told ...
  double turned_deg = 1.0;  ///< ... or that is turned so much
  double still_s = 3;       ///< a wall that was not heard for so long is told as it ended
  double again_s = 120;     ///< one that is heard again after so long as well

  void Describe(Archive& a);
};

/// Features that are told together.
struct FeatureBatch {
  int store = 0, batch = 0;
  std::vector<Feature> features;
};

/// The features of one run, each told with what is known of it by then, and again until it is acknowledged:
/// a radio that is silent for an hour delays what it brings, and loses nothing. What is told is what is new
/// or differs from what was told before.
class FeatureStore {
 public:
  static constexpr std::size_t kBatch = 2;
  static constexpr int kLastId = 4095;

  /// `store` names it, from 1; numbers of features mean nothing in another one.
  FeatureStore(const FeatureStoreConfig& config, const OdometryNoise& noise, int store);

  /// Takes a segment or a point that began or changed when the base was at `heard_at`.
  void Note(const FoundSegment& found, const Whereabouts& heard_at);
  void Note(const FoundPoint& found, const Whereabouts& heard_at);
  /// A point was seen through: whoever was told of it is told that it has gone.
  void NoteGone(int point_number);
  /// What is to be told now, when the time for a batch has come.
  std::optional<FeatureBatch> Next(const Whereabouts& base, Time now);
  /// The planner has batch `batch`, and of the eight before it those whose bit is set in `earlier` (bit 0:
  /// the one before). Store 0: it has nothing, and wants all.
  void Acknowledge(int store, int batch, unsigned earlier);

  std::size_t size() const { return records_.size(); }
  /// Features that were given up before they were acknowledged, because there was no room.
  int lost() const { return lost_; }

 private:
  struct Record {
    HeardFeature heard;
    std::optional<Feature> told{};  ///< as it was told last
    Time told_at{};
    int batch = -1;
    bool grew = true;  ///< at that time
    bool acknowledged = false;
    bool gone = false;
  };
  /// Walls and points have numbers of their own.
  enum class Kind { kWall, kPoint };
  using Name = std::pair<Kind, int>;
  void Note(const Name& name, HeardFeature heard);
  void BeginAnew();
  bool IsDue(const Record& record, const Feature& feature, Time now) const;
  bool Differs(const Record& record, const Feature& feature, Time now) const;
  bool Ended(const Record& record, Time now) const;
  void MakeRoom();

  FeatureStoreConfig config_;
  OdometryNoise noise_;
  int store_, batch_ = 0, lost_ = 0;
  int last_id_ = 0;
  std::map<Name, int> ids_;        ///< of what was noted, in this store
  std::map<int, Record> records_;  ///< by id
  std::optional<Time> sent_;
};

}  // namespace priamos::robot
