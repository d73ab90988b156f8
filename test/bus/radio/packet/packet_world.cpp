#include "packet_world.hpp"

#include <algorithm>

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kTick{1000};
constexpr double kLatency_s = 0.005;

LinkOptions Packets(double bytes_per_s, Duration overhead, std::size_t packet, std::size_t bundle,
                    HalfDuplex half_duplex, Duration keep_alive) {
  return {.bytes_per_s = bytes_per_s,
          .max_bundle_bytes = bundle,
          .keep_alive = keep_alive,
          .silence = 6 * keep_alive,
          .half_duplex = half_duplex,
          .line_delay = FromSeconds(2 * kLatency_s),
          .datagrams = true,
          .packet_overhead = overhead,
          .packet_bytes = packet};
}

PacketAirConfig AirOf(const PacketRadio& radio, double loss) {
  return {.bytes_per_s = radio.options.bytes_per_s,
          .overhead_s = Seconds(radio.options.packet_overhead),
          .latency_s = kLatency_s,
          .loss = loss,
          .half_duplex = radio.options.half_duplex.turn > Duration::zero()};
}

std::size_t NumberIn(const std::vector<std::byte>& packed) {
  std::size_t number = 0;
  for (std::size_t b = 0; b < 4; ++b) number |= std::to_integer<std::size_t>(packed.at(b)) << 8 * b;
  return number;
}

}  // namespace

PacketRadio DutyCycleRadio() {
  PacketRadio radio{"TwoChannelsDuty10", Packets(684, Duration(20'000), 222, 80, {}, Duration(2'000'000)), 3,
                    60, Duration(20'000'000)};
  radio.options.duty = DutyCycle(0.1, FromSeconds(600));
  return radio;
}

std::vector<PacketRadio> PacketRadios() {
  return {
      {"LoRaSF7",
       Packets(684, Duration(20'000), 222, 120, {Duration(900'000), Duration(20'000)}, Duration(1'000'000)),
       1.5, 20},
      {"TwoChannelsSF7", Packets(684, Duration(20'000), 222, 120, {}, Duration(500'000)), 1, 8},
      {"Fast20k",
       Packets(2500, Duration(5'000), 250, 120, {Duration(400'000), Duration(5'000)}, Duration(500'000)), 0.7,
       8},
      DutyCycleRadio()};
}

std::vector<LinkChannel> PacketChannels(double unit_s, Duration time_to_live) {
  std::vector<LinkChannel> channels = TestChannels();
  for (LinkChannel& c : channels) {
    c.rate_hz = 1 / unit_s;
    c.ttl = c.channel_class == ChannelClass::kCommand ? time_to_live : Duration::zero();
    if (c.max_bits > 8 * 100) c.max_bits = 8 * 40;
    if (c.fixed_bits > 8 * 20) c.fixed_bits = c.max_bits = 8 * 20;
  }
  return channels;
}

PacketWorld::PacketWorld(const PacketRadio& radio, double loss, std::uint64_t seed)
    : radio_(radio),
      rng_(Rng::Stream(seed, "packets")),
      air_(AirOf(radio, loss), Rng::Stream(seed, "air"), kStart),
      now_(kStart),
      channels_(PacketChannels(radio.unit_s, radio.time_to_live)) {
  for (End& end : ends_)
    end.link = std::make_unique<LinkEndpoint>(
        ChannelTable(channels_, false), end.outgoing, LinkKey{1, 2, 3}, radio.options, end.store,
        [](std::size_t, std::span<const std::byte> encoded, Time) {
          return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
        },
        [this] { return rng_.engine()(); }, now_);
}

void PacketWorld::Run(double seconds, bool offer) {
  for (const Time end = now_ + FromSeconds(seconds); now_ < end; now_ += kTick) {
    if (offer) Offer();
    for (std::size_t side = 0; side < 2; ++side) Send(side);
    for (std::size_t side = 0; side < 2; ++side) Receive(side);
  }
}

double PacketWorld::LargestShare(Duration window) const {
  double largest = 0;
  for (const End& end : ends_) {
    Duration inside{};
    for (std::size_t first = 0, last = 0; last < end.on_air.size(); ++last) {
      inside += end.on_air[last].second - end.on_air[last].first;
      for (; end.on_air[last].second - end.on_air[first].first > window; ++first)
        inside -= end.on_air[first].second - end.on_air[first].first;
      largest = std::max(largest, Seconds(inside) / Seconds(window));
    }
  }
  return largest;
}

void PacketWorld::Offer() {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const LinkChannel& c = channels_[i];
    const Time due = kStart + FromSeconds(radio_.unit_s * (1 + 0.13 * static_cast<double>(i)));
    Time& next = next_.try_emplace(i, due).first->second;
    if (now_ < next) continue;
    // Never sooner than the rate allows, at times that drift over each other.
    next = now_ + FromSeconds(rng_.Uniform(1.0, 1.6) * radio_.unit_s);
    std::vector<std::byte> message(c.max_bits / 8);
    const std::size_t number = offered[i]++;
    for (std::size_t b = 0; b < std::min<std::size_t>(4, message.size()); ++b)
      message[b] = static_cast<std::byte>(number >> 8 * b);
    End& end = c.direction == Direction::kUp ? ends_[0] : ends_[1];
    refused += end.link->Offer(i, message, now_) == OfferResult::kAccepted ? 0 : 1;
    offered_at_[i].push_back(now_);
  }
}

void PacketWorld::Send(std::size_t side) {
  std::vector<std::byte> frame;
  for (const std::byte b : ends_[side].link->Step(now_)) {
    frame.push_back(b);
    if (b == kDelimiter) Transmit(side, std::exchange(frame, {}));
  }
  torn += frame.empty() ? 0 : 1;
}

void PacketWorld::Transmit(std::size_t side, std::vector<std::byte> frame) {
  ++packets;
  longest_packet = std::max(longest_packet, frame.size());
  const Time free = air_.free_at(side);
  overlaps += free > now_ + Duration(4000) + FromSeconds(4 / radio_.options.bytes_per_s) ? 1 : 0;
  air_.Send(side, std::move(frame), now_);
  ends_[side].on_air.push_back({std::max(free, now_), air_.free_at(side)});
}

void PacketWorld::Receive(std::size_t side) {
  for (const std::vector<std::byte>& packet : air_.Receive(side, now_)) {
    const auto content = std::span(packet).first(packet.size() - 1);
    for (const Delivery& d : ends_[side].link->ReceiveFrame(content, now_, now_, false).deliveries) Note(d);
  }
}

void PacketWorld::Note(const Delivery& delivery) {
  const ChannelClass kind = channels_[delivery.channel].channel_class;
  if (kind == ChannelClass::kEvent) return NoteEvent(delivery);
  ++received[delivery.channel];
  const Duration age = now_ - offered_at_[delivery.channel].at(NumberIn(delivery.packed));
  late += kind == ChannelClass::kCommand && age > radio_.time_to_live ? 1 : 0;
  latencies[delivery.channel].push_back(age - FromSeconds(kLatency_s));
}

/// An event of one byte carries the last digits of its number: enough to know its place.
void PacketWorld::NoteEvent(const Delivery& delivery) {
  const std::size_t number = received[delivery.channel]++;
  const std::vector<Time>& at = offered_at_[delivery.channel];
  if (number >= at.size() || delivery.packed.at(0) != static_cast<std::byte>(number)) {
    ++disordered;
    return;
  }
  latencies[delivery.channel].push_back(now_ - at[number] - FromSeconds(kLatency_s));
}

}  // namespace priamos::bus::radio
