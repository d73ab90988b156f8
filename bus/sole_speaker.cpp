#include "bus/sole_speaker.hpp"

#include <algorithm>

namespace priamos::bus {

void SoleSpeaker::Excuse(std::uint64_t sender, Time now) {
  std::erase_if(excused_until_, [&](const auto& entry) { return entry.second <= now; });
  excused_until_[sender] = now + kExcused;
  foreign_.erase(sender);
}

bool SoleSpeaker::IsExcused(std::uint64_t sender, Time now) const {
  const auto found = excused_until_.find(sender);
  return found != excused_until_.end() && now < found->second;
}

void SoleSpeaker::Hear(std::uint64_t sender, std::string_view channel, Time now) {
  if (std::find(channels_.begin(), channels_.end(), channel) == channels_.end()) return;
  if (!IsExcused(sender, now)) foreign_.try_emplace(sender, ForeignSender{std::string(channel), now});
}

std::optional<SoleSpeaker::Intruder> SoleSpeaker::Find(Time now, Duration grace) const {
  for (const auto& [sender, foreign] : foreign_)
    if (now - foreign.first >= grace) return Intruder{sender, foreign.channel};
  return std::nullopt;
}

}  // namespace priamos::bus
