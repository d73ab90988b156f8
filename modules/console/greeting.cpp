#include "console/greeting.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "bus/version.hpp"
#include "common/robot/robot_drawing.hpp"
#include "console/core/json_line.hpp"
#include "console/plan_json.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

double StaleAfter(std::string_view name, const bus::radio::LinkConfig& link) {
  double longest_s = 0;
  std::apply(
      [&](const auto&... channel) {
        ((channel.name == name ? void(longest_s = std::chrono::duration<double>(channel.stale_after).count())
                               : void()),
         ...);
      },
      channels::kAll);
  if (longest_s == 0) return 0;
  for (const auto& channel : link.channels)
    if (channel.name == name) longest_s = std::max(longest_s, channel.ttl_s);
  return longest_s;
}

Json Channels(const bus::radio::LinkConfig& link) {
  const std::set<std::string> on_request = OnRequest(link);
  Json all = Json::object();
  for (const std::string_view name : kShownChannels)
    all[std::string(name)] = {{"stale_after_s", StaleAfter(name, link)},
                              {"on_request", on_request.contains(std::string(name))}};
  return all;
}

Json Speed(const SpeedRange& range) {
  return {{"speed_m_s", range.speed_m_s}, {"turn_rad_s", range.turn_rad_s}};
}

}  // namespace

std::set<std::string> OnRequest(const bus::radio::LinkConfig& link) {
  std::set<std::string> names;
  for (const auto& channel : link.channels)
    if (channel.on_request) names.insert(channel.name);
  return names;
}

std::string Greeting(const ConsoleConfig& config, const GroundPlan& plan, const bus::radio::LinkConfig& link,
                     std::optional<double> replay_s) {
  Json hello = {{"type", "hello"},
                {"version", bus::Version()},
                {"plan", ToJson(plan)},
                {"body", {{"length_m", config.body.length_m}, {"width_m", config.body.width_m}}},
                {"head", {{"x_m", kDrawnHead.x_m}, {"y_m", kDrawnHead.y_m}, {"z_m", kDrawnHead.z_m}}},
                {"link", {{"bytes_per_s", link.BytesPerSecond()}}},
                {"speed", {{"slow", Speed(config.pilot.slow)}, {"fast", Speed(config.pilot.fast)}}},
                {"channels", Channels(link)},
                {"video", !config.video.empty() && !replay_s}};
  if (replay_s) hello["replay"] = std::isfinite(*replay_s) ? Json{{"length_s", *replay_s}} : Json::object();
  return JsonLine(hello);
}

}  // namespace priamos::console
