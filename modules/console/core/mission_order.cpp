#include "console/core/mission_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "common/ground_plan.hpp"
#include "console/core/json_fields.hpp"
#include "console/core/read_json.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;
using Kind = MissionOrder::Kind;

constexpr int kLastOrder = 65535, kMostRounds = 9999;
constexpr double kLongest_m = 180;

constexpr std::array<std::pair<std::string_view, Kind>, 10> kOrders{{{"abort", Kind::kAbort},
                                                                     {"pause", Kind::kPause},
                                                                     {"resume", Kind::kResume},
                                                                     {"cancel", Kind::kCancel},
                                                                     {"pass_door", Kind::kPassDoor},
                                                                     {"goto", Kind::kGoto},
                                                                     {"corridor", Kind::kCorridor},
                                                                     {"explore", Kind::kExplore},
                                                                     {"locate", Kind::kLocate},
                                                                     {"patrol", Kind::kPatrol}}};

Kind KindIn(const json& object) {
  const std::string order = Word(object, "order", 20);
  const auto* found =
      std::find_if(kOrders.begin(), kOrders.end(), [&](const auto& o) { return o.first == order; });
  if (found != kOrders.end()) return found->second;
  std::string names;
  for (const auto& [name, kind] : kOrders) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  throw Wrong("order: expected one of " + names);
}

/// Beside `type` and `order` no other key.
void RefuseKeysBeside(const json& object, std::initializer_list<std::string_view> known) {
  json rest = object;
  rest.erase("type");
  rest.erase("order");
  RefuseOtherKeys(rest, known);
}

Target ReadTarget(const json& object) {
  return {ReadPlaceFields(object), Flag(object, "turn")};
}

/// The corridor's direction, if `turn`; else the way the base stands.
std::optional<Target> ReadDirection(const json& object) {
  if (!Flag(object, "turn")) return std::nullopt;
  return Target{{0, 0, WrapAngle(Number(object, "yaw_rad", -3.15, 3.15))}};
}

std::vector<Target> ReadPlaces(const json& object) {
  const json& places = Field(object, "places");
  if (!places.is_array() || places.empty() || places.size() > MissionOrder::kMostPlaces)
    throw Wrong(fmt::format("places: expected 1 to {} places", MissionOrder::kMostPlaces));
  std::vector<Target> read;
  for (const json& place : places) {
    if (!place.is_object()) throw Wrong("places: expected objects");
    RefuseOtherKeys(place, {"x_m", "y_m", "yaw_rad", "turn"});
    read.push_back(ReadTarget(place));
  }
  return read;
}

}  // namespace

Pose2 ReadPlaceFields(const json& object) {
  constexpr double kMap_m = 100, kTurn_rad = 3.15;
  return {Number(object, "x_m", -kMap_m, kMap_m), Number(object, "y_m", -kMap_m, kMap_m),
          WrapAngle(Number(object, "yaw_rad", -kTurn_rad, kTurn_rad))};
}

MissionOrder ReadMissionOrder(const json& object) {
  MissionOrder order;
  order.kind = KindIn(object);
  switch (order.kind) {
    case Kind::kPassDoor:
      RefuseKeysBeside(object, {"landmark"});
      order.landmark_id = int(Whole(object, "landmark", kFirstLandmarkId, kLastLandmarkId));
      break;
    case Kind::kGoto:
      RefuseKeysBeside(object, {"x_m", "y_m", "yaw_rad", "turn"});
      order.goal = ReadTarget(object);
      break;
    case Kind::kCorridor:
      RefuseKeysBeside(object, {"yaw_rad", "turn", "distance_m"});
      order.goal = ReadDirection(object);
      order.distance_m = Number(object, "distance_m", 0, kLongest_m);
      break;
    case Kind::kCancel:
      RefuseKeysBeside(object, {"number"});
      order.order_id = int(Whole(object, "number", 1, kLastOrder));
      break;
    case Kind::kPatrol:
      RefuseKeysBeside(object, {"places", "rounds"});
      order.places = ReadPlaces(object);
      order.rounds = int(Whole(object, "rounds", 0, kMostRounds));
      break;
    default:
      RefuseKeysBeside(object, {});
  }
  return order;
}

}  // namespace priamos::console
