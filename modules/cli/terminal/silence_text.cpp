#include "cli/terminal/silence_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/text/nearest_word.hpp"

namespace priamos::cli {
namespace {

std::string Shown(const BusSound& bus) {
  return bus.name == bus.url ? bus.url : fmt::format("{} ({})", bus.name, bus.url);
}

const BusSound::Channel* Find(const BusSound& bus, const std::string& name) {
  const auto at =
      std::find_if(bus.channels.begin(), bus.channels.end(), [&](const auto& c) { return c.name == name; });
  return at == bus.channels.end() ? nullptr : &*at;
}

std::string Rate(const BusSound::Channel& channel) {
  return channel.rate_hz > 0 ? fmt::format("{:.1f} Hz", channel.rate_hz) : "now and then";
}

/// Names of channels near to `channel`: of what is heard if something is near, else of what there can be.
std::string Nearest(const std::string& channel, const BusSound& here, const std::vector<std::string>& known) {
  std::vector<std::string> heard;
  for (const auto& c : here.channels) heard.push_back(c.name);
  std::string text;
  for (const std::string& name : NearestWords(channel, heard))
    text +=
        fmt::format("{}\"{}\" ({})", text.empty() ? "; nearest: " : " or ", name, Rate(*Find(here, name)));
  return text.empty() ? NearestText(channel, known) : text;
}

std::string Elsewhere(const BusSound& other, const BusSound::Channel& channel) {
  return fmt::format("; it is on {} ({}): --bus {}", other.name, Rate(channel), other.name);
}

std::string NothingAtAll(const BusSound& here, const std::optional<BusSound>& other) {
  const std::string text = fmt::format("nothing is heard on {}", Shown(here));
  if (other && !other->channels.empty())
    return text + fmt::format("; {} carries {} channels: --bus {}", other->name, other->channels.size(),
                              other->name);
  return text + "; is anything up (priamos status), and is there a route for multicast (priamos doctor)?";
}

}  // namespace

std::string SilenceText(const std::string& channel, const BusSound& here,
                        const std::optional<BusSound>& other, const std::vector<std::string>& known,
                        const std::vector<std::string>& events) {
  const auto* elsewhere = other ? Find(*other, channel) : nullptr;
  if (elsewhere == nullptr && (channel.empty() || here.channels.empty())) return NothingAtAll(here, other);
  if (elsewhere != nullptr)
    return fmt::format("nobody publishes {} on {}{}", channel, Shown(here), Elsewhere(*other, *elsewhere));
  if (std::find(events.begin(), events.end(), channel) != events.end())
    return fmt::format("no {} on {} so far; it is sent when something happens", channel, Shown(here));
  return fmt::format(
      "nobody publishes {} on {}{}", channel, Shown(here),
      std::find(known.begin(), known.end(), channel) == known.end() ? Nearest(channel, here, known) : "");
}

}  // namespace priamos::cli
