#pragma once

#include <string>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/link_options.hpp"
#include "bus/schema/schema.hpp"
#include "common/archive.hpp"
#include "common/input/section_place.hpp"

namespace priamos::bus::radio {

/// Settings of one channel that crosses the link: a `[[channel]]` of link.toml.
struct LinkChannelConfig {
  std::string name;                     ///< name of the LCM channel, not empty
  std::string type;                     ///< message type, with its package if the name alone is ambiguous
  std::string direction = "up";         ///< "up": robot to workstation; "down": workstation to robot
  std::string channel_class = "state";  ///< "state", "event" or "command": see ChannelClass
  double rate_hz = 1;     ///< [1/s] 0.001..1000: highest rate of messages; of events: their mean rate
  int burst = 1;          ///< [-] 1..64: largest number of messages that come at once
  int priority = 4;       ///< [-] 0..15: 0 is sent first
  double ttl_s = 0;       ///< [s] 0..600: age from which a message is not sent, a command not obeyed; 0: none
  double deadline_s = 0;  ///< [s] 0..600: latest arrival that the budget must guarantee; 0: none
  double fresh_s = 0;  ///< [s] 0..600: of a state: from any moment on, a younger one has left within; 0: none
  bool urgent = false;      ///< may cut off the frame being sent; as an event not limited by `rate_hz`
  bool on_request = false;  ///< sent only while somebody listens on the other side
  bool delta = false;       ///< sent as a difference to an acknowledged message whenever that is shorter
  std::string key;  ///< text field of the type: the newest message per value of it is kept; empty: no key
  int keys = 1;     ///< [-] 1..64: largest number of values of `key`
  SectionPlace place{};  ///< where it was read, for errors
  void Describe(Archive& a);
  friend bool operator==(const LinkChannelConfig&, const LinkChannelConfig&) = default;
};

/// [s] The line is fed once per millisecond, not always in time.
inline constexpr double kFeedGap_s = 0.0015;

/// Contents of link.toml: the settings that both ends of one link must share, and those of the sender.
struct LinkConfig {
  int baud = 9600;              ///< [baud] 300..1000000: rate of the serial port, 10 bits per byte
  double air_rate_bytes_s = 0;  ///< [byte/s] 0..1e6: rate of the radio if it is slower; 0: as the port
  int ahead_bytes = 2;          ///< [byte] 0..16: bytes written ahead of the line
  int max_bundle_bytes = 120;   ///< [byte] 30..240, with robots 16..240: size of a bundle of several messages
  double keep_alive_s = 0.25;   ///< [s] 0.05..10: longest silence of an end
  double silence_s = 1.5;       ///< [s] 0.1..60, above `keep_alive_s`: silence after which the link is down
  double ageing_s = 1;          ///< [s] 0.05..600: waiting time for which a message gains one priority level
  int code_bytes = 0;      ///< [byte] 4, 6 or 8: authentication code of a frame; 0: as the line's rate asks
  bool encrypted = false;  ///< contents are encrypted; they are authenticated in any case
  double half_duplex_turn_s = 0;  ///< [s] 0..10: half-duplex: longest turn of an end; 0: full duplex
  double turnaround_s = 0.02;     ///< [s] 0..1: half-duplex: time from sending to hearing
  double line_delay_s = 0.1;  ///< [s] 0..60: delay of the line, there and back, in which commands are proven
  bool datagrams = false;     ///< IP link: one frame per UDP datagram, whose 28 bytes of header count as sent
  /// "bytes": a line or an IP link; "packet": a radio that sends packets, which nothing can cut off.
  std::string medium = "bytes";
  double packet_overhead_s = 0;  ///< [s] 0..5: packet: time on air of a packet beside its frame, above 0
  int mtu_bytes = 222;           ///< [byte] 50..255: packet: largest packet of the radio
  double duty_cycle = 1;         ///< 0.001..1: packet: share of `duty_window_s` that an end may be on the air
  double duty_window_s = 3600;   ///< [s] 1..86400: packet: window of any place in which `duty_cycle` holds
  int robots = 0;          ///< [-] 0..8: robots on the channel, which a station polls; 0: a link of two ends
  double grace_s = 0.005;  ///< [s] 0.001..0.1: robots: so late a polled robot begins at most
  std::string key_file = "link.key";  ///< secret key of the link, made by `priamos link keygen`, mode 0600
  bool simulation_key = false;        ///< uses a key that everybody knows: only for emulated lines
  std::vector<LinkChannelConfig> channels;  ///< channels of the link, at both ends in the same order
  SectionPlace place{};                     ///< where it was read, for errors

  void Describe(Archive& a);
  /// Bytes per second of the slower of line and radio.
  double BytesPerSecond() const;
  /// Bytes of the authentication code of a data frame, 4, 6 or 8: `code_bytes`, or by the rule of
  /// forgery.hpp.
  std::size_t CodeBytes() const;
  LinkOptions Options() const;
  /// The channels with their packed sizes. Throws ConfigError with one sentence for a type that is unknown
  /// or cannot be packed, or a key that is no text field of it.
  ChannelTable Table(const Schema& schema) const;
  friend bool operator==(const LinkConfig&, const LinkConfig&) = default;

 private:
  void DescribeLine(Archive& a);
  void DescribeMedium(Archive& a);
  void RefuseContradictions(Archive& a) const;
  void RefuseFreshness() const;
  void RefuseWithoutEffect(Archive& a) const;
};

}  // namespace priamos::bus::radio
