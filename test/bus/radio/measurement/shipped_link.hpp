#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bus/own_types.hpp"
#include "bus/radio/link_config.hpp"
#include "common/config.hpp"
#include "numbered_message.hpp"

namespace priamos::bus::radio {

/// The link of the simulation, as it is shipped.
inline LinkConfig ShippedLink() {
  return LoadConfig<LinkConfig>(std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/link.toml");
}

/// Its channels for a LinkPair, which packs a message as its bytes: whole bytes, and no differences.
inline std::vector<LinkChannel> ShippedChannels(const LinkConfig& config) {
  std::vector<LinkChannel> channels = config.Table(OwnTypes()).channels();
  for (LinkChannel& c : channels) {
    c.max_bits = (c.max_bits + 7) / 8 * 8;
    if (c.fixed_bits > 0) c.fixed_bits = c.max_bits;
    c.delta.clear();
  }
  return channels;
}

/// Starts both ends of a pair anew as the shipped link.
inline void UseShippedLink(LinkPair& pair) {
  const LinkConfig config = ShippedLink();
  for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
    end->options = config.Options();
    end->channels = ShippedChannels(config);
    end->store.Lose();
    pair.Start(*end);
  }
}

/// Index of a channel of the pair.
inline std::size_t ChannelOf(const LinkPair& pair, std::string_view name) {
  std::size_t i = 0;
  while (pair.onboard.channels.at(i).name != name) ++i;
  return i;
}

}  // namespace priamos::bus::radio
