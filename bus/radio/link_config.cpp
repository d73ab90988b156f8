#include "bus/radio/link_config.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "bus/radio/frame/forgery.hpp"
#include "bus/schema/packing.hpp"
#include "common/archive.hpp"
#include "common/input/quoted.hpp"
#include "common/input/section_place.hpp"

namespace priamos::bus::radio {
namespace {

/// LCM's own limit; and a name goes to terminals as it is.
constexpr std::size_t kLongestName = 63;

bool IsChannelName(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return c > 0x20 && c < 0x7F; });
}

/// Nothing is shorter than a tick of the process.
constexpr double kShortest_s = 0.001;

/// Whether all messages of a type have the same packed size.
bool HasFixedSize(const Struct& type) {
  return std::all_of(type.fields.begin(), type.fields.end(), [](const Field& f) {
    const bool variable =
        std::any_of(f.dims.begin(), f.dims.end(), [](const Dimension& d) { return d.variable; });
    return !variable && f.kind != Kind::kString && (f.type == nullptr || HasFixedSize(*f.type));
  });
}

/// Types that differ only in annotations have one fingerprint, but other bits.
std::uint64_t CodesHash(const Packer& packer) {
  std::string text;
  for (const PackedField& field : packer.fields()) text += field.codes + "\n";
  std::array<unsigned char, 16> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), nullptr, 0);
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) value = value << 8 | hash[static_cast<std::size_t>(i)];
  return value;
}

ValueWidths DeltaWidths(const LinkChannel& channel, const Struct& type) {
  if (!HasFixedSize(type))
    throw ConfigError(fmt::format("{}: expected false with {}, whose messages differ in size, got true",
                                  channel.At("delta"), type.full_name));
  return Packer(type).ValueWidths();
}

ChannelClass ClassOf(const std::string& name) {
  if (name == "event") return ChannelClass::kEvent;
  return name == "command" ? ChannelClass::kCommand : ChannelClass::kState;
}

void CheckKey(const LinkChannel& channel, const std::string& key, const Struct& type) {
  if (key.empty()) return;
  const auto field =
      std::find_if(type.fields.begin(), type.fields.end(), [&](const Field& f) { return f.name == key; });
  if (field == type.fields.end() || field->kind != Kind::kString || !field->dims.empty())
    throw ConfigError(fmt::format("{}: expected a text field of {}, got {}", channel.At("key"),
                                  type.full_name, Quoted(key)));
}

LinkChannel ToChannel(const LinkChannelConfig& c, const Schema& schema) {
  LinkChannel channel;
  channel.name = c.name;
  channel.place = c.place;
  const Struct* type = schema.Find(c.type);
  if (type == nullptr)
    throw ConfigError(fmt::format("{}: expected the name of a known .lcm type, got {}", channel.At("type"),
                                  Quoted(c.type)));
  CheckKey(channel, c.key, *type);
  channel.direction = c.direction == "up" ? Direction::kUp : Direction::kDown;
  channel.channel_class = ClassOf(c.channel_class);
  try {
    const Packer packer(*type);
    channel.fingerprint = type->fingerprint ^ CodesHash(packer);
    channel.max_bits = static_cast<std::uint32_t>(packer.MaxBits());
  } catch (const SchemaError& error) {
    throw ConfigError(fmt::format("{}: expected a type that can be packed, got {}: {}", channel.At("type"),
                                  type->full_name, error.what()));
  }
  channel.fixed_bits = HasFixedSize(*type) ? channel.max_bits : 0;
  if (c.delta) channel.delta = DeltaWidths(channel, *type);
  channel.priority = c.priority;
  channel.rate_hz = c.rate_hz;
  channel.burst = c.burst;
  channel.ttl = FromSeconds(c.ttl_s);
  channel.deadline = FromSeconds(c.deadline_s);
  channel.fresh = FromSeconds(c.fresh_s);
  channel.urgent = c.urgent;
  channel.on_request = c.on_request;
  channel.max_keys = c.key.empty() ? 1 : c.keys;
  return channel;
}

}  // namespace

void LinkChannelConfig::Describe(Archive& a) {
  a.Text("name", name, "LCM channel");
  a.Text("type", type, "its message type, with package if the name alone is ambiguous");
  a.Choice("direction", direction, {"up", "down"}, "up: robot to workstation");
  a.Choice("class", channel_class, {"state", "event", "command"},
           "state: newest wins; event: acknowledged, in order, exactly once; command: newest wins, refused "
           "when old");
  a.Number("rate_hz", rate_hz, {"1/s", 0.001, 1000, "at most this often; of an event: so often in the mean"});
  a.Integer("burst", burst, {"-", 1, 64, "largest number of messages that come at once"});
  a.Integer("priority", priority, {"-", 0, 15, "0 goes first"});
  a.Number("ttl_s", ttl_s, {"s", 0, 600, "not sent when older, a command not obeyed either; 0: no limit"});
  a.Number("deadline_s", deadline_s, {"s", 0, 600, "latest arrival that the budget must guarantee; 0: any"});
  a.Number("fresh_s", fresh_s,
           {"s", 0, 600,
            "of a state: from any moment on, one that was made after it has left within so long; 0: any"});
  a.Flag("urgent", urgent,
         "goes at once, also in the middle of another frame; as an event never held back by its rate");
  a.Flag("on_request", on_request, "is sent only while somebody listens on the other side");
  a.Flag("delta", delta,
         "sent as difference to one that the other end is known to have, whenever that is shorter");
  a.Text("key", key, "text field of the type: newest wins per value of it; empty: newest of all");
  a.Integer("keys", keys, {"-", 1, 64, "values of `key` at most"});
  NotePlace(a, place);
  a.Require("direction", "up or down");
  a.Require("class", "state, event or command");
  if (!IsChannelName(name)) a.Refuse("name", "the name of an LCM channel: 1 to 63 printable characters");
  if (channel_class == "command" && ttl_s < kShortest_s)
    a.Refuse("ttl_s", "a time-to-live of at least 0.001, as every command needs");
  if (ttl_s > 0 && ttl_s < kShortest_s) a.Refuse("ttl_s", "0 for no limit, or at least 0.001");
  if (deadline_s > 0 && deadline_s < kShortest_s) a.Refuse("deadline_s", "0 for any, or at least 0.001");
  if (channel_class == "event" && ttl_s > 0) a.Refuse("ttl_s", "none: an event is delivered, however late");
  if (fresh_s > 0 && fresh_s < kShortest_s) a.Refuse("fresh_s", "0 for no bound, or at least 0.001");
  if (fresh_s > 0 && (channel_class != "state" || !key.empty() || on_request))
    a.Refuse("fresh_s", "0: a bound is for a channel of class state without a key, which is always sent");
  if (delta && (channel_class != "state" || !key.empty()))
    a.Refuse("delta", "false: differences are for channels of class state without a key");
  if (channel_class != "state" && !key.empty()) a.Refuse("key", "none: keys are for channels of class state");
  if (keys != 1 && key.empty()) a.Refuse("keys", "1 without a key, of which there would be so many");
}

void LinkConfig::Describe(Archive& a) {
  DescribeLine(a);
  DescribeMedium(a);
  a.Integer("code_bytes", code_bytes,
            {"byte", 0, 8,
             "4, 6 or 8: authentication code of a frame; 0: the shortest that keeps a line full of forgeries "
             "out for 180 days, 8 for datagrams"});
  a.Flag("encrypted", encrypted, "hides what is sent; it is authenticated in any case");
  a.Text("key_file", key_file, "secret key of the link, made by `priamos link keygen`, mode 0600");
  a.Flag("simulation_key", simulation_key, "use a key that everybody knows: only for emulated lines");
  a.List("channel", channels,
         "the channels that cross the link; their order is part of what both ends agree on");
  NotePlace(a, place);
  if (code_bytes % 2 != 0 || code_bytes == 2) a.Refuse("code_bytes", "4, 6, 8, or 0 for the default");
  RefuseContradictions(a);
  RefuseWithoutEffect(a);
}

void LinkConfig::DescribeLine(Archive& a) {
  a.Integer("baud", baud, {"baud", 300, 1000000, "baud rate of the serial port, 10 bits per byte"});
  a.Number("air_rate_bytes_s", air_rate_bytes_s,
           {"byte/s", 0, 1e6, "what the radio itself carries when that is less; 0: as much as the port"});
  a.Integer("ahead_bytes", ahead_bytes,
            {"byte", 0, 16,
             "written ahead of the line: more fills gaps of a busy computer, less lets urgent messages pass "
             "sooner"});
  a.Integer("max_bundle_bytes", max_bundle_bytes,
            {"byte", 16, 240, "messages sent together in one frame; 30 at least without robots"});
  a.Number("keep_alive_s", keep_alive_s, {"s", 0.05, 10, "longest silence of an end"});
  a.Number("silence_s", silence_s, {"s", 0.1, 60, "the link is down when nothing came for so long"});
  a.Number("ageing_s", ageing_s, {"s", 0.05, 600, "a waiting message gains one level of priority per this"});
}

/// What the radio is like, if it is no line of two directions.
void LinkConfig::DescribeMedium(Archive& a) {
  a.Number(
      "half_duplex_turn_s", half_duplex_turn_s,
      {"s", 0, 10, "one radio channel for both directions: longest time one end talks; 0: two directions"});
  a.Number("turnaround_s", turnaround_s, {"s", 0, 1, "half-duplex: from sending to hearing"});
  a.Number(
      "line_delay_s", line_delay_s,
      {"s", 0, 60,
       "delay of the line, there and back, in which the budget must prove commands fresh; on a slower one "
       "they are refused"});
  a.Flag("datagrams", datagrams,
         "an IP link: one frame per UDP datagram, whose 28 bytes of head count as sent");
  a.Choice("medium", medium, {"bytes", "packet"},
           "packet: a radio that sends packets, through a bridge that takes one per UDP datagram");
  a.Number("packet_overhead_s", packet_overhead_s,
           {"s", 0, 5, "packet: time on air of a packet beside its frame: preamble and header"});
  a.Integer("mtu_bytes", mtu_bytes, {"byte", 50, 255, "packet: largest packet of the radio, a frame in it"});
  a.Number("duty_cycle", duty_cycle,
           {"-", 0.001, 1, "packet: share of duty_window_s that an end may be on the air; 1: no limit"});
  a.Number("duty_window_s", duty_window_s,
           {"s", 1, 86400, "packet: any window of so long, in which duty_cycle holds"});
  a.Integer("robots", robots,
            {"-", 0, 8,
             "robots on one half-duplex channel, each with its address and key, which a station polls; 0: a "
             "link of two ends"});
  a.Number("grace_s", grace_s,
           {"s", 0.001, 0.1,
            "robots: a polled one begins at most so late, or keeps silent: its process's delays"});
}

double LinkConfig::BytesPerSecond() const {
  const double port = baud / 10.0;
  return air_rate_bytes_s > 0 ? std::min(air_rate_bytes_s, port) : port;
}

std::size_t LinkConfig::CodeBytes() const {
  if (code_bytes > 0) return static_cast<std::size_t>(code_bytes);
  // Over IP, also to the bridge of a radio, a stranger's tries are not limited by the rate of the link.
  return Options().datagrams ? kLongCodeBytes : DefaultCodeBytes(BytesPerSecond());
}

LinkOptions LinkConfig::Options() const {
  // A faster line sends many bytes between two ticks of the process, and must not stand idle.
  const int between_ticks = static_cast<int>(std::ceil(kFeedGap_s * BytesPerSecond()));
  return {.bytes_per_s = BytesPerSecond(),
          .ahead_bytes = std::max(ahead_bytes, between_ticks),
          .max_bundle_bytes = static_cast<std::size_t>(max_bundle_bytes),
          .keep_alive = FromSeconds(keep_alive_s),
          .silence = FromSeconds(silence_s),
          .ageing = FromSeconds(ageing_s),
          .half_duplex = {FromSeconds(half_duplex_turn_s), FromSeconds(turnaround_s)},
          .line_delay = FromSeconds(line_delay_s),
          .datagrams = datagrams || medium == "packet",
          .packet_overhead = FromSeconds(packet_overhead_s),
          .packet_bytes = medium == "packet" ? static_cast<std::size_t>(mtu_bytes) : 0,
          .duty = DutyCycle(duty_cycle, FromSeconds(duty_window_s)),
          .robots = static_cast<std::uint8_t>(robots),
          .grace = FromSeconds(grace_s),
          .place = place};
}

ChannelTable LinkConfig::Table(const Schema& schema) const {
  if (channels.empty() || channels.size() > ChannelTable::kMaxChannels)
    throw ConfigError(fmt::format("{}: expected 1 to {} [[channel]] tables, got {}", place.Of("channel"),
                                  ChannelTable::kMaxChannels, channels.size()));
  std::vector<LinkChannel> table;
  for (const LinkChannelConfig& c : channels) table.push_back(ToChannel(c, schema));
  try {
    return {std::move(table), encrypted, CodeBytes()};
  } catch (const std::invalid_argument& error) {
    throw ConfigError(error.what());
  }
}

}  // namespace priamos::bus::radio
