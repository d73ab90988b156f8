#include "console/core/browser_message.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/robot/robot_drawing.hpp"
#include "console/core/json_fields.hpp"
#include "console/core/read_json.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;

constexpr std::int64_t kMaxBeat = std::int64_t{1} << 53;  // JavaScript counts so far

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
  report.beat = Whole(object, "beat", 0, kMaxBeat);
  report.axis = Axes(object);
  report.hold = Flag(object, "hold");
  report.rearm = Flag(object, "rearm");
  report.take_over = Flag(object, "take_over");
  report.mode = Flag(object, "mode");
  report.range = Flag(object, "range");
  return report;
}

PlaceOrder ReadPlace(const json& object) {
  RefuseOtherKeys(object, {"type", "x_m", "y_m", "yaw_rad"});
  return {ReadPlaceFields(object)};
}

AimOrder ReadAim(const json& object) {
  RefuseOtherKeys(object, {"type", "pan_rad", "tilt_rad", "vergence_rad", "zoom_step", "focus_step"});
  const auto step = [&](const char* key) {
    return object.contains(key) ? std::optional(int(Whole(object, key, 0, kDrawnHead.most_step)))
                                : std::nullopt;
  };
  AimOrder aim{Number(object, "pan_rad", -kDrawnHead.most_pan_rad, kDrawnHead.most_pan_rad),
               Number(object, "tilt_rad", -kDrawnHead.most_tilt_rad, kDrawnHead.most_tilt_rad), std::nullopt,
               step("zoom_step"), step("focus_step")};
  if (object.contains("vergence_rad"))
    aim.vergence_rad = Number(object, "vergence_rad", 0, kDrawnHead.most_vergence_rad);
  return aim;
}

AlarmSeen ReadAlarmSeen(const json& object) {
  constexpr std::int64_t kLastTime = std::int64_t{1} << 53;
  RefuseOtherKeys(object, {"type", "source", "utime"});
  return {Word(object, "source", 16), Whole(object, "utime", 0, kLastTime)};
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
    return {kLog, wish.name, Whole(object, "end", 0, kFarthest)};
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
  if (type == "mission") return ReadMissionOrder(object);
  if (type == "place") return ReadPlace(object);
  if (type == "listen") return ReadListen(object);
  if (type == "aim") return ReadAim(object);
  if (type == "alarm") return ReadAlarmSeen(object);
  if (type == "parameter") return ReadParameter(object);
  if (type == "process") return ReadProcess(object);
  if (type == "replay") return ReadReplay(object);
  if (type != "stop")
    throw Wrong(
        "type: expected stick, stop, mission, place, aim, alarm, listen, parameter, process or replay");
  return StopOrder{};  // obeyed whatever else the message has
}

}  // namespace

Outcome<BrowserMessage> ReadBrowserMessage(std::string_view text) {
  return ReadJson<BrowserMessage>(text, kMaxBrowserMessage, ReadObject);
}

}  // namespace priamos::console
