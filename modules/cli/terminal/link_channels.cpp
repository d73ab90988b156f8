#include "cli/terminal/link_channels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "common/input/quoted.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::cli {

void LinkChannels::Add(const link_status_t& report) {
  n_all_ = static_cast<std::size_t>(std::max<int>(0, report.all_channels));
  for (int i = 0; i < report.n_channels; ++i) {
    const link_channel_t& channel = report.channels[static_cast<std::size_t>(i)];
    outgoing_[channel.channel] = channel.outgoing != 0;
  }
}

std::optional<std::string> LinkChannels::WhyNot(const std::string& channel) const {
  const auto found = outgoing_.find(channel);
  if (found != outgoing_.end() && found->second)
    return fmt::format("channel: expected one that the other end sends, got {}, which this end sends",
                       Quoted(channel));
  if (found != outgoing_.end() || !complete()) return std::nullopt;
  std::vector<std::string> incoming;
  incoming.reserve(outgoing_.size());
  for (const auto& [name, is_outgoing] : outgoing_)
    if (!is_outgoing) incoming.push_back(name);
  return fmt::format("channel: expected one that the other end of the link sends ({}), got {}{}",
                     fmt::join(incoming, ", "), Quoted(channel), NearestText(channel, incoming));
}

}  // namespace priamos::cli
