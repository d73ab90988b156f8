#include "robot/core/features/feature_store.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace priamos::robot {
namespace {

constexpr int kBatches = 256, kStores = 65535;
/// A place that is so much surer than it was told is worth telling, as long as it was not known to ...
constexpr double kSurer = 0.6, kSure_m = 0.02;
constexpr double kEndMoved_m = 0.1;

double AcrossSigma(const Feature& feature) {
  return std::sqrt(std::max(0.0, feature.covariance(0, 0)));
}

double YawSigma(const Feature& feature) {
  return std::sqrt(std::max(0.0, feature.covariance(1, 1)));
}

}  // namespace

void FeatureStoreConfig::Describe(Archive& a) {
  a.Integer("most", most, {"-", 10, 2000, "features that are kept"});
  a.Number("period_s", period_s, {"s", 0.2, 60, "between two batches; not below 1 / rate_hz of FEATURES"});
  a.Number("repeat_s", repeat_s, {"s", 1, 600, "a batch not acknowledged by then is told again"});
  a.Number("grown_m", grown_m, {"m", 0.1, 5, "a wall that grew so much is told again"});
  a.Number("moved_m", moved_m, {"m", 0.005, 1, "one whose middle moved so much is told again"});
  a.Number("turned_deg", turned_deg, {"deg", 0.1, 20, "one that turned so much is told again"});
  a.Number("still_s", still_s, {"s", 0.5, 60, "a wall not heard for so long is told as it ended"});
  a.Number("again_s", again_s, {"s", 5, 3600, "one that is heard after so long is told again"});
}

FeatureStore::FeatureStore(const FeatureStoreConfig& config, const OdometryNoise& noise, int store)
    : config_(config), noise_(noise), store_(std::clamp(store, 1, kStores)) {}

void FeatureStore::Note(const FoundSegment& found, const Whereabouts& heard_at) {
  Note({Kind::kWall, found.number}, HeardFeatureOf(found, heard_at));
}

void FeatureStore::Note(const FoundPoint& found, const Whereabouts& heard_at) {
  Note({Kind::kPoint, found.number}, HeardFeatureOf(found, heard_at));
}

void FeatureStore::Note(const Name& name, HeardFeature heard) {
  if (!ids_.contains(name) && last_id_ == kLastId) BeginAnew();
  const auto [entry, is_new] = ids_.try_emplace(name, last_id_ + 1);
  last_id_ += is_new;
  records_[entry->second].heard = std::move(heard);
  MakeRoom();
}

void FeatureStore::NoteGone(int point_number) {
  const auto id = ids_.find({Kind::kPoint, point_number});
  const auto entry = id == ids_.end() ? records_.end() : records_.find(id->second);
  if (entry == records_.end()) return;
  if (entry->second.batch < 0)
    records_.erase(entry);
  else
    entry->second = {.heard = entry->second.heard, .gone = true};
}

/// When all ids are used up a new store begins: none ever names two features.
void FeatureStore::BeginAnew() {
  for (const auto& [id, record] : records_) lost_ += !record.acknowledged;
  records_.clear();
  ids_.clear();
  last_id_ = 0;
  store_ = store_ % kStores + 1;
}

void FeatureStore::MakeRoom() {
  while (records_.size() > static_cast<std::size_t>(config_.most)) {
    const auto oldest = std::min_element(records_.begin(), records_.end(), [](const auto& a, const auto& b) {
      return std::tuple(!a.second.acknowledged, a.second.heard.heard) <
             std::tuple(!b.second.acknowledged, b.second.heard.heard);
    });
    lost_ += !oldest->second.acknowledged;
    records_.erase(oldest);
  }
}

std::optional<FeatureBatch> FeatureStore::Next(const Whereabouts& base, Time now) {
  if (sent_ && Seconds(now - *sent_) < config_.period_s) return std::nullopt;
  struct Due {
    Record* record;
    Feature feature;
  };
  std::vector<Due> due;
  for (auto& [id, record] : records_) {
    Feature feature = InMap(id, record.heard, base, noise_);
    feature.gone = record.gone;
    if (IsDue(record, feature, now)) due.push_back({&record, feature});
  }
  if (due.empty()) return std::nullopt;
  // One place is for what grew most since it was told: that is what the base drives along. The others are for
  // what was never told, or longest ago: everything has its turn.
  const auto grown_m = [](const Due& d) {
    return d.feature.length_m - (d.record->told ? d.record->told->length_m : 0);
  };
  std::stable_sort(due.begin(), due.end(), [](const Due& a, const Due& b) {
    return std::tuple(a.record->told.has_value(), a.record->told_at) <
           std::tuple(b.record->told.has_value(), b.record->told_at);
  });
  const auto most = std::max_element(due.begin(), due.end(),
                                     [&](const Due& a, const Due& b) { return grown_m(a) < grown_m(b); });
  std::rotate(due.begin(), most, most + 1);
  if (due.size() > kBatch) due.resize(kBatch);
  sent_ = now;
  batch_ = (batch_ + 1) % kBatches;
  FeatureBatch batch{store_, batch_, {}};
  for (Due& d : due) {
    const bool grew = !Ended(*d.record, now);
    *d.record = {d.record->heard, d.feature, now, batch_, grew, false, d.record->gone};
    batch.features.push_back(d.feature);
  }
  return batch;
}

void FeatureStore::Acknowledge(int store, int batch, unsigned earlier) {
  if (store == 0) {
    std::erase_if(records_, [](const auto& entry) { return entry.second.gone; });
    for (auto& [id, record] : records_) record = {.heard = record.heard};
    return;
  }
  if (store != store_) return;
  for (auto& [id, record] : records_) {
    if (record.batch < 0) continue;
    const int before = (batch - record.batch + kBatches) % kBatches;
    if (before == 0 || (before <= 8 && (earlier >> (before - 1)) & 1U)) record.acknowledged = true;
  }
  std::erase_if(records_, [](const auto& entry) { return entry.second.gone && entry.second.acknowledged; });
}

bool FeatureStore::IsDue(const Record& record, const Feature& feature, Time now) const {
  if (!record.told || (!record.gone && Differs(record, feature, now))) return true;
  return !record.acknowledged && Seconds(now - record.told_at) >= config_.repeat_s;
}

bool FeatureStore::Differs(const Record& record, const Feature& feature, Time now) const {
  const Feature& told = *record.told;
  const Pose2 told_from_now = told.map_from_middle.Inverse() * feature.map_from_middle;
  const double grown_m = feature.length_m - told.length_m;
  if (feature.IsPoint() && told_from_now.translation().norm() > std::max(config_.moved_m, AcrossSigma(told)))
    return true;
  // Along a wall its middle moves when it grows.
  const double across_m = std::abs(told_from_now.y - told_from_now.x * std::sin(told_from_now.yaw));
  if (grown_m >= config_.grown_m) return true;
  if (record.grew && Ended(record, now) && grown_m >= kEndMoved_m) return true;
  if (across_m > std::max(config_.moved_m, AcrossSigma(told))) return true;
  if (std::abs(told_from_now.yaw) > std::max(Radians(config_.turned_deg), YawSigma(told))) return true;
  if (AcrossSigma(told) > kSure_m && AcrossSigma(feature) < kSurer * AcrossSigma(told)) return true;
  return Seconds(feature.seen - told.seen) > config_.again_s;
}

bool FeatureStore::Ended(const Record& record, Time now) const {
  return !record.heard.grows || Seconds(now - record.heard.heard) > config_.still_s;
}

}  // namespace priamos::robot
