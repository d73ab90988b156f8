#include "cli/front/estop_silence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/wire/lcm_bus.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {
namespace {

/// More would be a list and no hint.
constexpr std::size_t kMostNames = 5;

std::string Names(const std::set<std::string>& channels) {
  std::vector<std::string> names(channels.begin(), channels.end());
  const std::size_t more = names.size() > kMostNames ? names.size() - kMostNames : 0;
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace

std::string WhyNoAnswer(const EstopEar& here, const std::optional<EstopEar>& other) {
  const std::string answer(channels::kDriveStatus.name);
  if (other && other->channels.contains(answer) && !here.channels.contains(answer))
    return fmt::format("{} is heard on {}: --bus {}", answer, other->name, other->name);
  if (here.channels.contains(answer))
    return fmt::format("{} is heard, but shows no change; is the robot busy, or out of the radio's range?",
                       answer);
  if (!here.channels.empty())
    return fmt::format("heard there: {}; but no {} of a robot", Names(here.channels), answer);
  if (other && !other->channels.empty())
    return fmt::format("nothing is heard there; {} carries {} channels: --bus {}", other->name,
                       other->channels.size(), other->name);
  return "nothing is heard there; is anything up (priamos status), and is there a route for multicast "
         "(priamos doctor)?";
}

struct EstopSilence::Side {
  Side(const std::string& name, const std::string& url) : ear{name, {}}, bus(url) {
    bus.SubscribeEverything([this](std::string_view channel, std::span<const std::byte>) {
      if (channel != channels::kEstop.name) ear.channels.emplace(channel);
    });
  }
  EstopEar ear;
  bus::LcmBus bus;
};

EstopSilence::EstopSilence(const bus::BusChoice& choice) {
  bus::BusChoice other = choice;
  try {
    sides_.push_back(std::make_unique<Side>(choice.bus, choice.Url()));
    if (choice.bus != "onboard" && choice.bus != "offboard") return;
    other.bus = choice.bus == "onboard" ? "offboard" : "onboard";
    sides_.push_back(std::make_unique<Side>(other.bus, other.Url()));
  } catch (const std::exception&) {
    // A hint is not worth an e-stop.
  }
}

EstopSilence::~EstopSilence() = default;

void EstopSilence::Drain() {
  for (const auto& side : sides_) side->bus.Drain();
}

std::string EstopSilence::Why() const {
  if (sides_.empty()) return "nothing could be heard there; is there a route for multicast (priamos doctor)?";
  return WhyNoAnswer(sides_.front()->ear,
                     sides_.size() > 1 ? std::optional(sides_.back()->ear) : std::nullopt);
}

}  // namespace priamos::cli
