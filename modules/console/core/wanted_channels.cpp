#include "console/core/wanted_channels.hpp"

namespace priamos::console {

bool WantedChannels::Wish(ClientId client, const std::string& channel, bool on) {
  if (!offered_.contains(channel)) return false;
  if (on)
    viewers_[channel].insert(client);
  else
    viewers_[channel].erase(client);
  return true;
}

void WantedChannels::Leave(ClientId client) {
  for (auto& [channel, viewers] : viewers_) viewers.erase(client);
}

std::vector<WantedChannels::Request> WantedChannels::Step(Time now) {
  std::vector<Request> requests;
  for (const auto& [channel, viewers] : viewers_) {
    const auto asked = asked_.find(channel);
    if (viewers.empty()) {
      if (asked == asked_.end()) continue;
      asked_.erase(asked);
      requests.push_back({channel, 0});
    } else if (asked == asked_.end() || now - asked->second >= kAgain) {
      asked_[channel] = now;
      requests.push_back({channel, kHold_s});
    }
  }
  return requests;
}

}  // namespace priamos::console
