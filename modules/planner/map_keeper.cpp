#include "planner/map_keeper.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace priamos::planner {
namespace {

/// What changes often is not written each time.
constexpr double kWriteEvery_s = 5;
constexpr int kBatches = 256, kRemembered = 8;

bool Within(double value, double low, double high) {
  return value >= low && value <= high;  // false for NaN
}

/// Since 1970, as far as the file of the map goes [us].
bool IsTime(std::int64_t utime) {
  constexpr double kLast_us = 1e17;
  return Within(static_cast<double>(utime), 0, kLast_us);
}

/// Of a field that is known not to be negative.
unsigned char Counted(std::int8_t value) {
  return static_cast<unsigned char>(value);
}

}  // namespace

std::optional<SeenFeature> FromMessage(int store, const feature_t& m) {
  constexpr double kMap_m = 100, kYaw = 3.15, kLeast_m = 0.05;
  const bool is_wall = m.kind == feature_t::WALL, is_point = m.kind == feature_t::POINT;
  const bool good = Within(store, 1, 65535) && Within(m.id, 0, 4095) &&
                    (is_wall || is_point || m.kind == feature_t::GONE) && Within(m.x_m, -kMap_m, kMap_m) &&
                    Within(m.y_m, -kMap_m, kMap_m) && Within(m.yaw_rad, -kYaw, kYaw) &&
                    Within(m.length_m, is_wall ? kLeast_m : 0, 6.35) && Within(m.sigma_across_m, 0, 1.27) &&
                    Within(m.sigma_yaw_rad, 0, 0.255) && Within(m.rho, -1, 1) &&
                    Within(m.sigma_end_m, 0, 0.6) && IsTime(m.utime_seen);
  if (!good) return std::nullopt;
  const double seen_s = static_cast<double>(m.utime_seen) * 1e-6;
  if (is_point) {
    const LearnedPoint point{m.x_m, m.y_m, m.sigma_across_m, seen_s};
    return SeenFeature{store, m.id, point, m.sigma_end_m, m.yaw_rad - kPi / 2};
  }
  if (!is_wall) return SeenFeature{store, m.id};
  LearnedWall wall;
  wall.x_m = m.x_m;
  wall.y_m = m.y_m;
  wall.yaw_deg = Degrees(WrapAngle(m.yaw_rad));
  wall.length_m = m.length_m;
  wall.sigma_across_m = m.sigma_across_m;
  wall.sigma_yaw_deg = Degrees(m.sigma_yaw_rad);
  wall.rho = m.rho;
  wall.sigma_end_m = m.sigma_end_m;
  wall.seen_s = seen_s;
  return SeenFeature{store, m.id, wall};
}

std::optional<LearnedDoor> FromMessage(const door_found_t& m) {
  constexpr double kMap_m = 100, kYaw = 3.15;
  constexpr std::array<const char*, 4> kStates{"unknown", "closed", "ajar", "open"};
  const bool good =
      Within(m.x_m, -kMap_m, kMap_m) && Within(m.y_m, -kMap_m, kMap_m) && Within(m.yaw_rad, -kYaw, kYaw) &&
      Within(m.width_m, 0.3, 2.55) && Within(m.sigma_along_m, 0, 0.63) && Within(m.sigma_across_m, 0, 0.63) &&
      Within(m.state, 0, 3) && Within(m.log_odds, 0, 31) && Within(m.looks, 1, 63) && IsTime(m.utime_seen);
  if (!good) return std::nullopt;
  LearnedDoor door;
  door.x_m = m.x_m;
  door.y_m = m.y_m;
  door.yaw_deg = Degrees(WrapAngle(m.yaw_rad));
  door.width_m = m.width_m;
  door.sigma_along_m = m.sigma_along_m;
  door.sigma_across_m = m.sigma_across_m;
  door.state = kStates[Counted(m.state)];
  door.state_log_odds = m.log_odds;
  door.looks = Counted(m.looks);
  door.seen_s = static_cast<double>(m.utime_seen) * 1e-6;
  return door;
}

std::optional<LearnedObject> FromMessage(const scene_object_t& m) {
  constexpr double kMap_m = 100, kYaw = 3.15, kSize_m = 5.1, kHeight_m = 2.5, kSigma = 0.63;
  constexpr std::array<const char*, 3> kKinds{"edge", "face", "box"};
  const bool good = Within(m.kind, 0, 2) && Within(m.x_m, -kMap_m, kMap_m) &&
                    Within(m.y_m, -kMap_m, kMap_m) && Within(m.yaw_rad, -kYaw, kYaw) &&
                    Within(m.width_m, 0, kSize_m) && Within(m.depth_m, 0, kSize_m) &&
                    Within(m.bottom_m, 0, kHeight_m) && Within(m.top_m, m.bottom_m, kHeight_m) &&
                    Within(m.sigma_along_m, 0, kSigma) && Within(m.sigma_across_m, 0, kSigma) &&
                    Within(m.sigma_yaw_rad, 0, kSigma) && Within(m.looks, 0, 63) && IsTime(m.utime_seen);
  const bool has_front = good && (m.kind == scene_object_t::EDGE || m.width_m > 0);
  if (!has_front) return std::nullopt;
  LearnedObject object;
  object.told_id = m.id;
  object.kind = kKinds[Counted(m.kind)];
  object.x_m = m.x_m;
  object.y_m = m.y_m;
  object.yaw_deg = Degrees(WrapAngle(m.yaw_rad));
  object.width_m = m.kind == scene_object_t::EDGE ? 0 : m.width_m;
  object.depth_m = m.kind == scene_object_t::BOX ? m.depth_m : 0;
  object.bottom_m = m.bottom_m;
  object.top_m = m.top_m;
  object.sigma_along_m = m.sigma_along_m;
  object.sigma_across_m = m.sigma_across_m;
  object.sigma_yaw_deg = Degrees(m.sigma_yaw_rad);
  object.looks = Counted(m.looks);
  object.seen_s = static_cast<double>(m.utime_seen) * 1e-6;
  return object;
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
      doors_(context.node().SubscribeAll(channels::kDoorFound)),
      objects_(context.node().SubscribeAll(channels::kSceneObject)),
      orders_(context.node().SubscribeAll(channels::kMapCommand)),
      acks_(context.node().Advertise(channels::kFeaturesAck)) {}

MapKeeper::~MapKeeper() {
  if (IsToBeWritten()) SaveLearnedWalls(file_, map_.walls());
}

std::shared_ptr<const LearnedWalls> MapKeeper::Tick(Time now) {
  // Who begins with nothing asks for all that the robot has found so far.
  if (!greeted_ && map_.walls().walls.empty() && map_.walls().points.empty()) acks_.Publish(features_ack_t{});
  greeted_ = true;
  const bool was_reset = TakeOrders(now);
  const bool new_walls = TakeFeatures(), new_doors = TakeDoors(), new_objects = TakeObjects();
  const bool changed = new_walls || new_doors || new_objects || was_reset || std::exchange(replaced_, false);
  const bool due = was_reset || !wrote_ || Seconds(now - *wrote_) >= kWriteEvery_s;
  if (due && IsToBeWritten()) {
    wrote_ = now;
    Write();
  }
  return changed ? walls() : nullptr;
}

void MapKeeper::Replace(LearnedWalls walls) {
  map_.Replace(std::move(walls));
  replaced_ = true;
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
      context_.LogRefusal(channels::kFeatures.name, "features refused: numbers out of range");
    }
  }
  return changed;
}

bool MapKeeper::TakeDoors() {
  bool changed = false;
  for (const door_found_t& message : doors_.Drain()) {
    const auto told = FromMessage(message);
    if (!told) context_.LogRefusal(channels::kDoorFound.name, "a door refused: numbers out of range");
    changed = (told && map_.Take(*told)) || changed;
  }
  return changed;
}

bool MapKeeper::TakeObjects() {
  bool changed = false;
  for (const scene_object_t& message : objects_.Drain()) {
    const auto told = FromMessage(message);
    if (!told)
      context_.LogRefusal(channels::kSceneObject.name,
                          fmt::format("thing {} of the head refused: numbers out of range", message.id));
    // The head goes on telling what it saw before the map was forgotten.
    changed = (told && told->seen_s > reset_s_ && map_.Take(*told)) || changed;
  }
  return changed;
}

bool MapKeeper::TakeOrders(Time now) {
  bool was_reset = false;
  for (const map_command_t& order : orders_.Drain()) {
    if (order.action != map_command_t::RESET) {
      context_.LogRefusal(channels::kMapCommand.name,
                          fmt::format("map order {} refused: no such action", order.action));
      continue;
    }
    const LearnedWalls& known = map_.walls();
    context_.Log(
        bus::Level::kInfo,
        fmt::format("the learned map is forgotten: {} walls, {} points, {} doors, {} things",
                    known.walls.size(), known.points.size(), known.doors.size(), known.objects.size()));
    map_.Reset();
    reset_s_ = static_cast<double>(ToUtime(now)) * 1e-6;
    was_reset = true;
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
