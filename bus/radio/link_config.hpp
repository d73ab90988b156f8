#pragma once

#include <string>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/link_options.hpp"
#include "bus/schema/schema.hpp"
#include "common/config.hpp"

namespace priamos::bus::radio {

/// One `[[channel]]` of link.toml.
struct LinkChannelConfig {
  std::string name;
  std::string type;
  std::string direction = "up";
  std::string channel_class = "state";
  double rate_hz = 1;
  int burst = 1;
  int priority = 4;
  double ttl_s = 0;
  double deadline_s = 0;
  bool urgent = false;
  bool on_request = false;
  bool delta = false;
  std::string key;
  int keys = 1;
  void Describe(Archive& a);
  friend bool operator==(const LinkChannelConfig&, const LinkChannelConfig&) = default;
};

/// link.toml: the settings that both ends of one link must share, and those of the sender.
struct LinkConfig {
  int baud = 9600;
  double air_rate_bytes_s = 0;
  int ahead_bytes = 2;
  int max_bundle_bytes = 120;
  double keep_alive_s = 0.25;
  double silence_s = 1.5;
  double ageing_s = 1;
  bool encrypted = false;
  double half_duplex_turn_s = 0;
  double turnaround_s = 0.02;
  double line_delay_s = 0.1;
  bool datagrams = false;
  std::string key_file = "link.key";
  bool simulation_key = false;
  std::vector<LinkChannelConfig> channels;

  void Describe(Archive& a);
  /// Bytes per second of the slower of line and radio.
  double BytesPerSecond() const;
  LinkOptions Options() const;
  /// The channels with their packed sizes. Throws ConfigError with one sentence for a type that is unknown
  /// or cannot be packed, or a key that is no text field of it.
  ChannelTable Table(const Schema& schema) const;
  friend bool operator==(const LinkConfig&, const LinkConfig&) = default;
};

}  // namespace priamos::bus::radio
