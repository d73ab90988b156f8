#include "planner/map_keeper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

namespace priamos::planner {
namespace {

/// What changes often is not written each time.
constexpr double kWriteEvery_s = 5;
constexpr int kBatches = 256, kRemembered = 8;

bool Within(double value, double low, double high) {
  return value >= low && value <= high;  // false for NaN
}

}  // namespace

std::optional<SeenWall> FromMessage(int store, const feature_t& m) {
  constexpr double kMap_m = 100, kYaw = 3.15, kLeast_m = 0.05;
  const bool good = Within(store, 1, 65535) && Within(m.id, 0, 4095) &&
                    (m.kind == feature_t::WALL || m.kind == feature_t::GONE) &&
                    Within(m.x_m, -kMap_m, kMap_m) && Within(m.y_m, -kMap_m, kMap_m) &&
                    Within(m.yaw_rad, -kYaw, kYaw) && Within(m.length_m, kLeast_m, 6.35) &&
                    Within(m.sigma_across_m, 0, 1.27) && Within(m.sigma_yaw_rad, 0, 0.255) &&
                    Within(m.rho, -1, 1) && Within(m.sigma_end_m, 0, 0.6) && m.utime_seen >= 0;
  if (!good) return std::nullopt;
  SeenWall seen{store, m.id, m.kind == feature_t::GONE, {}};
  seen.wall.x_m = m.x_m;
  seen.wall.y_m = m.y_m;
  seen.wall.yaw_deg = Degrees(WrapAngle(m.yaw_rad));
  seen.wall.length_m = m.length_m;
  seen.wall.sigma_across_m = m.sigma_across_m;
  seen.wall.sigma_yaw_deg = Degrees(m.sigma_yaw_rad);
  seen.wall.rho = m.rho;
  seen.wall.sigma_end_m = m.sigma_end_m;
  seen.wall.seen_s = static_cast<double>(m.utime_seen) * 1e-6;
  return seen;
}

std::vector<features_t> ToMessages(const LearnedWalls& walls, int store) {
  constexpr double kPiece_m = 6;
  constexpr std::size_t kMost = 2;
  std::vector<features_t> messages;
  int id = 0;
  for (const LearnedWall& wall : walls.walls) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(wall.length_m / kPiece_m)));
    for (int i = 0; i < pieces; ++i) {
      if (messages.empty() || messages.back().features.size() == kMost) {
        messages.emplace_back();
        messages.back().store = store;
        messages.back().batch = static_cast<std::int16_t>((messages.size() - 1) % kBatches);
      }
      const Eigen::Vector2d middle = wall.At(wall.length_m * ((i + 0.5) / pieces - 0.5));
      feature_t feature{};
      feature.id = static_cast<std::int16_t>(id++ % 4096);
      feature.kind = feature_t::WALL;
      feature.utime_seen = static_cast<std::int64_t>(wall.seen_s * 1e6);
      feature.x_m = middle.x();
      feature.y_m = middle.y();
      feature.yaw_rad = WrapAngle(Radians(wall.yaw_deg));
      feature.length_m = wall.length_m / pieces;
      feature.sigma_across_m = wall.sigma_across_m;
      feature.sigma_yaw_rad = Radians(wall.sigma_yaw_deg);
      feature.rho = wall.rho;
      feature.sigma_end_m = wall.sigma_end_m;
      messages.back().features.push_back(feature);
      messages.back().n_features = static_cast<std::int8_t>(messages.back().features.size());
    }
  }
  return messages;
}

features_ack_t BatchLog::Note(int store, int batch) {
  const int ahead = (batch - newest_ + kBatches) % kBatches;
  if (store != store_) {
    store_ = store;
    newest_ = batch;
    earlier_ = 0;
  } else if (ahead > 0 && ahead < kBatches / 2) {
    earlier_ = ahead > kRemembered ? 0 : ((earlier_ << 1U | 1U) << static_cast<unsigned>(ahead - 1)) & 0xffU;
    newest_ = batch;
  } else if (const int behind = kBatches - ahead; ahead > 0 && behind <= kRemembered) {
    earlier_ |= 1U << static_cast<unsigned>(behind - 1);
  }
  features_ack_t ack{};
  ack.store = store_;
  ack.batch = static_cast<std::int16_t>(newest_);
  ack.earlier = static_cast<std::int16_t>(earlier_);
  return ack;
}

MapKeeper::MapKeeper(const PlannerConfig& config, bus::Context& context)
    : file_(config.learned_map.empty() ? "" : context.ResolvePath(config.learned_map)),
      context_(context),
      map_(config.learned, file_.empty() ? LearnedWalls{} : LoadLearnedWalls(file_)),
      written_(map_.walls().revision),
      features_(context.node().SubscribeAll(channels::kFeatures)),
      orders_(context.node().SubscribeAll(channels::kMapCommand)),
      acks_(context.node().Advertise(channels::kFeaturesAck)),
      maps_(context.node().Advertise(channels::kMapWalls)) {}

MapKeeper::~MapKeeper() {
  if (IsToBeWritten()) SaveLearnedWalls(file_, map_.walls());
}

std::shared_ptr<const LearnedWalls> MapKeeper::Tick(Time now) {
  // Who begins with nothing asks for all that the robot has found so far.
  if (!greeted_ && map_.walls().walls.empty()) acks_.Publish(features_ack_t{});
  greeted_ = true;
  const bool was_reset = TakeOrders();
  const bool changed = TakeFeatures() || was_reset || std::exchange(replaced_, false);
  const bool due = was_reset || !wrote_ || Seconds(now - *wrote_) >= kWriteEvery_s;
  if (due && IsToBeWritten()) {
    wrote_ = now;
    Write();
  }
  return changed ? walls() : nullptr;
}

void MapKeeper::Replace(LearnedWalls walls) {
  constexpr int kStores = 65535;
  map_.Replace(std::move(walls));
  replaced_ = true;
  n_maps_ = n_maps_ % kStores + 1;
  for (const features_t& message : ToMessages(map_.walls(), n_maps_)) maps_.Publish(message);
}

bool MapKeeper::TakeFeatures() {
  bool changed = false;
  for (const features_t& message : features_.Drain()) {
    bool good = Within(message.batch, 0, kBatches - 1);
    for (const feature_t& feature : message.features) {
      const auto seen = FromMessage(message.store, feature);
      good = good && seen;
      if (!seen) continue;
      told_.push_back(*seen);
      changed = map_.Take(*seen) || changed;
    }
    if (good) {
      acks_.Publish(batches_.Note(message.store, message.batch));
    } else {
      context_.Log(bus::Level::kWarning, "features refused: numbers out of range");
    }
  }
  return changed;
}

bool MapKeeper::TakeOrders() {
  bool was_reset = false;
  for (const map_command_t& order : orders_.Drain()) {
    if (order.action != map_command_t::RESET) {
      context_.Log(bus::Level::kWarning, fmt::format("map order {} refused: no such action", order.action));
      continue;
    }
    const std::size_t walls = map_.walls().walls.size();
    map_.Reset();
    was_reset = true;
    context_.Log(bus::Level::kInfo, fmt::format("the learned map is forgotten: {} walls", walls));
  }
  return was_reset;
}

/// The map of today learns nothing from a log of another day.
bool MapKeeper::IsToBeWritten() const {
  return !file_.empty() && !context_.from_log() && map_.walls().revision != written_;
}

void MapKeeper::Write() {
  if (SaveLearnedWalls(file_, map_.walls())) {
    written_ = map_.walls().revision;
    complained_ = false;
  } else if (!complained_) {
    complained_ = true;
    context_.Log(bus::Level::kError,
                 fmt::format("{}: the learned map is not kept: {}", file_, std::strerror(errno)));
  }
}

}  // namespace priamos::planner
