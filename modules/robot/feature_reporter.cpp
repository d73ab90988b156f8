#include "robot/feature_reporter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace priamos::robot {
namespace {

constexpr int kStores = 65535;
/// As far as feature_t goes.
constexpr double kMostLength_m = 6.35, kMostSigma_m = 1.27, kMostSigma_rad = 0.255, kMostEnd_m = 0.6;

std::int8_t KindOf(const Feature& feature) {
  if (feature.gone) return feature_t::GONE;
  return feature.IsPoint() ? feature_t::POINT : feature_t::WALL;
}

feature_t ToMessage(const Feature& feature) {
  feature_t message{};
  message.id = static_cast<std::int16_t>(feature.id);
  message.kind = KindOf(feature);
  message.utime_seen = ToUtime(feature.seen);
  message.x_m = feature.map_from_middle.x;
  message.y_m = feature.map_from_middle.y;
  message.yaw_rad = feature.map_from_middle.yaw;
  message.length_m = std::min(feature.length_m, kMostLength_m);
  const double across_m = std::sqrt(feature.covariance(0, 0)), yaw_rad = std::sqrt(feature.covariance(1, 1));
  message.sigma_across_m = std::min(across_m, kMostSigma_m);
  message.sigma_yaw_rad = std::min(yaw_rad, kMostSigma_rad);
  message.rho = std::clamp(feature.covariance(0, 1) / (across_m * yaw_rad), -1.0, 1.0);
  message.sigma_end_m = std::min(feature.end_sigma_m, kMostEnd_m);
  return message;
}

}  // namespace

features_t ToMessage(const FeatureBatch& batch) {
  features_t message{};
  message.store = batch.store;
  message.batch = static_cast<std::int16_t>(batch.batch);
  message.n_features = static_cast<std::int8_t>(batch.features.size());
  for (const Feature& feature : batch.features) message.features.push_back(ToMessage(feature));
  return message;
}

FeatureReporter::FeatureReporter(const RobotConfig& config, bus::Context& context)
    : config_(config.features),
      noise_(config.localiser.odometry.noise),
      context_(context),
      finder_(config.walls, noise_, config.drive.footprint),
      points_(config.points, noise_),
      acks_(context.node().SubscribeAll(channels::kFeaturesAck)),
      features_(context.node().Advertise(channels::kFeatures)) {}

Whereabouts FeatureReporter::BaseBy(const Localiser& localiser) const {
  const auto estimate = localiser.estimate();
  return {estimate->pose, estimate->covariance, localiser.odometry().pose(), finder_.travel_m()};
}

FeatureStore& FeatureReporter::Store(Time now) {
  if (!store_) store_.emplace(config_, noise_, 1 + static_cast<int>(ToUtime(now) / 1'000'000 % kStores));
  return *store_;
}

std::vector<const FoundSegment*> FeatureReporter::Hear(const SonarCycle& cycle, const Localiser& localiser,
                                                       Time now) {
  if (!localiser.estimate()) return {};
  HearPoints(localiser, now);
  auto changed = finder_.Add(cycle, localiser.OdometryPoseAt(cycle.time),
                             [&](const PlacedEcho& echo) { return points_.Explains(echo); });
  for (const FoundSegment* found : changed) Store(now).Note(*found, BaseBy(localiser));
  points_heard_ = cycle.time;
  return changed;
}

void FeatureReporter::HearPoints(const Localiser& localiser, Time now) {
  if (!points_heard_ || !localiser.estimate()) return;
  for (const FoundPoint* found : points_.Add(finder_.unexplained(), *points_heard_))
    Store(now).Note(*found, BaseBy(localiser));
  for (const int number : points_.SeeThrough(finder_.heard())) Store(now).NoteGone(number);
  points_heard_.reset();
}

void FeatureReporter::Tick(const Localiser& localiser, Time now) {
  for (const features_ack_t& ack : acks_.Drain())
    Store(now).Acknowledge(ack.store, ack.batch, static_cast<unsigned>(ack.earlier));
  if (!store_ || !localiser.estimate()) return;
  if (const auto batch = store_->Next(BaseBy(localiser), now)) features_.Publish(ToMessage(*batch));
  if (store_->lost() == lost_) return;
  lost_ = store_->lost();
  context_.Log(
      bus::Level::kWarning,
      fmt::format("{} features were given up before the planner had them: it has been silent for too long",
                  lost_));
}

}  // namespace priamos::robot
