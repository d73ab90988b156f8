#include "console/core/browser_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "common/ground_plan.hpp"
#include "console/core/read_json.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;

constexpr std::int64_t kMaxBeat = std::int64_t{1} << 53;  // JavaScript counts so far

void RefuseOtherKeys(const json& object, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Wrong(fmt::format("key \"{}\" is not known", key.substr(0, 40)));
}

const json& Field(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) throw Wrong(fmt::format("key \"{}\" is missing", key));
  return *it;
}

bool Flag(const json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return false;
  if (!it->is_boolean()) throw Wrong(fmt::format("{}: expected true or false", key));
  return it->get<bool>();
}

std::int64_t Whole(const json& value, const char* key, std::int64_t least, std::int64_t most) {
  const bool fits = value.is_number_integer() &&
                    !(value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(most)) &&
                    value.get<std::int64_t>() >= least && value.get<std::int64_t>() <= most;
  if (!fits) throw Wrong(fmt::format("{}: expected a whole number from {} to {}", key, least, most));
  return value.get<std::int64_t>();
}

std::string Word(const json& object, const char* key, std::size_t longest) {
  const json& value = Field(object, key);
  if (!value.is_string() || value.get_ref<const std::string&>().size() > longest)
    throw Wrong(fmt::format("{}: expected a text of at most {} bytes", key, longest));
  return value.get<std::string>();
}

std::array<double, kAxes> Axes(const json& object) {
  const json& values = Field(object, "axis");
  if (!values.is_array() || values.size() != kAxes)
    throw Wrong(fmt::format("axis: expected {} numbers", kAxes));
  std::array<double, kAxes> axes{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    const double value = values[i].is_number() ? values[i].get<double>() : 2;
    if (!(value >= -1 && value <= 1)) throw Wrong(fmt::format("axis[{}]: expected -1 to 1", i));
    axes[i] = value;
  }
  return axes;
}

StickReport ReadStick(const json& object) {
  RefuseOtherKeys(object, {"type", "beat", "axis", "hold", "rearm", "take_over", "mode", "range"});
  StickReport report;
  report.beat = Whole(Field(object, "beat"), "beat", 0, kMaxBeat);
  report.axis = Axes(object);
  report.hold = Flag(object, "hold");
  report.rearm = Flag(object, "rearm");
  report.take_over = Flag(object, "take_over");
  report.mode = Flag(object, "mode");
  report.range = Flag(object, "range");
  return report;
}

double Number(const json& object, const char* key, double least, double most) {
  const json& value = Field(object, key);
  const double number = value.is_number() ? value.get<double>() : most + 1;
  if (!(number >= least && number <= most))
    throw Wrong(fmt::format("{}: expected a number from {} to {}", key, least, most));
  return number;
}

Pose2 Place(const json& object) {
  constexpr double kMap_m = 100, kTurn_rad = 3.15;
  return {Number(object, "x_m", -kMap_m, kMap_m), Number(object, "y_m", -kMap_m, kMap_m),
          WrapAngle(Number(object, "yaw_rad", -kTurn_rad, kTurn_rad))};
}

MissionOrder ReadMission(const json& object) {
  using enum MissionOrder::Kind;
  const std::string order = Word(object, "order", 20);
  if (order == "abort") {
    RefuseOtherKeys(object, {"type", "order"});
    return {};
  }
  if (order == "pass_door") {
    RefuseOtherKeys(object, {"type", "order", "landmark"});
    const auto id = Whole(Field(object, "landmark"), "landmark", kFirstLandmarkId, kLastLandmarkId);
    return {kPassDoor, static_cast<int>(id), {}};
  }
  if (order != "goto") throw Wrong("order: expected abort, pass_door or goto");
  RefuseOtherKeys(object, {"type", "order", "x_m", "y_m", "yaw_rad", "turn"});
  return {kGoto, 0, {Place(object), Flag(object, "turn")}};
}

PlaceOrder ReadPlace(const json& object) {
  RefuseOtherKeys(object, {"type", "x_m", "y_m", "yaw_rad"});
  return {Place(object)};
}

ListenWish ReadListen(const json& object) {
  RefuseOtherKeys(object, {"type", "channel", "on"});
  return {Word(object, "channel", 63), Flag(object, "on")};
}

ParameterWish ReadParameter(const json& object) {
  using enum ParameterWish::Kind;
  constexpr double kFarthest = 10000;
  constexpr std::size_t kLongest = 100;
  const std::string action = Word(object, "action", 20);
  ParameterWish wish{kRead, Word(object, "process", 20), "", 0};
  if (action == "set") {
    RefuseOtherKeys(object, {"type", "action", "process", "key", "value"});
    return {kSet, wish.process, Word(object, "key", kLongest),
            Number(object, "value", -kFarthest, kFarthest)};
  }
  if (action == "read" && object.contains("key")) {
    RefuseOtherKeys(object, {"type", "action", "process", "key"});
    wish.key = Word(object, "key", kLongest);
    return wish;
  }
  RefuseOtherKeys(object, {"type", "action", "process"});
  if (action != "read" && action != "save" && action != "reset")
    throw Wrong("action: expected read, set, save or reset");
  wish.kind = action == "read" ? kRead : action == "save" ? kSave : kReset;
  return wish;
}

ProcessWish ReadProcess(const json& object) {
  using enum ProcessWish::Kind;
  constexpr std::size_t kLongest = 16;
  constexpr std::int64_t kFarthest = 2'000'000'000;
  const std::string action = Word(object, "action", 20);
  ProcessWish wish{kRestart, Word(object, "name", kLongest), 0};
  if (action == "log") {
    RefuseOtherKeys(object, {"type", "action", "name", "end"});
    return {kLog, wish.name, Whole(Field(object, "end"), "end", 0, kFarthest)};
  }
  RefuseOtherKeys(object, {"type", "action", "name"});
  if (action != "restart" && action != "new_world") throw Wrong("action: expected restart, log or new_world");
  wish.kind = action == "restart" ? kRestart : kNewWorld;
  return wish;
}

ReplayOrder ReadReplay(const json& object) {
  using enum ReplayOrder::Kind;
  constexpr double kLongest_s = 1e10;  // a log's times reach until 2255
  const std::string action = Word(object, "action", 20);
  const bool has_value = action == "seek" || action == "speed";
  if (has_value) {
    RefuseOtherKeys(object, {"type", "action", "value"});
    if (action == "seek") return {kSeek, Number(object, "value", 0, kLongest_s)};
    return {kSpeed, Number(object, "value", kSlowestReplay, kFastestReplay)};
  }
  RefuseOtherKeys(object, {"type", "action"});
  if (action == "play") return {kPlay};
  if (action == "pause") return {kPause};
  if (action == "step") return {kStep};
  throw Wrong("action: expected play, pause, step, seek or speed");
}

BrowserMessage ReadObject(const json& object) {
  if (!object.is_object()) throw Wrong("expected a JSON object");
  const std::string type = Word(object, "type", 20);
  if (type == "stick") return ReadStick(object);
  if (type == "mission") return ReadMission(object);
  if (type == "place") return ReadPlace(object);
  if (type == "listen") return ReadListen(object);
  if (type == "parameter") return ReadParameter(object);
  if (type == "process") return ReadProcess(object);
  if (type == "replay") return ReadReplay(object);
  if (type != "stop")
    throw Wrong("type: expected stick, stop, mission, place, listen, parameter, process or replay");
  RefuseOtherKeys(object, {"type"});
  return StopOrder{};
}

}  // namespace

Outcome<BrowserMessage> ReadBrowserMessage(std::string_view text) {
  return ReadJson<BrowserMessage>(text, kMaxBrowserMessage, ReadObject);
}

}  // namespace priamos::console
