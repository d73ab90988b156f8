#include "bus/radio/line/packet_air.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {

PacketAir::PacketAir(PacketAirConfig config, Rng rng, Time start)
    : config_(std::move(config)), rng_(rng), start_(start), free_at_{start, start} {}

void PacketAir::Send(std::size_t side, std::vector<std::byte> packet, Time now) {
  if (packet.empty() || packet.size() > config_.mtu_bytes) return;
  const Time from = std::max(now, free_at_[side]);
  const Time to =
      from + FromSeconds(config_.overhead_s + static_cast<double>(packet.size()) / config_.bytes_per_s);
  free_at_[side] = to;
  // Drawn for each packet, so that what happens to one does not change what happens to the next.
  const bool lost = rng_.Uniform(0, 1) < config_.loss;
  on_air_[side].push_back({from, to, std::move(packet), lost || IsCut(from, to)});
  if (config_.half_duplex) Collide(1 - side, on_air_[side].back());
}

void PacketAir::Collide(std::size_t other, Packet& packet) {
  for (Packet& p : on_air_[other]) {
    if (p.to <= packet.from || packet.to <= p.from) continue;
    p.lost = packet.lost = true;
    ++collisions_;
  }
}

bool PacketAir::IsCut(Time from, Time to) const {
  return std::any_of(config_.cuts.begin(), config_.cuts.end(), [&](const LineCut& cut) {
    return start_ + FromSeconds(cut.from_s) < to && from < start_ + FromSeconds(cut.to_s);
  });
}

std::vector<std::vector<std::byte>> PacketAir::Receive(std::size_t side, Time now) {
  std::vector<std::vector<std::byte>> received;
  std::deque<Packet>& coming = on_air_[1 - side];
  while (!coming.empty() && coming.front().to + FromSeconds(config_.latency_s) <= now) {
    if (!coming.front().lost) received.push_back(std::move(coming.front().bytes));
    coming.pop_front();
  }
  return received;
}

Time PacketAir::next_arrival() const {
  Time next = Time::max();
  for (const auto& packets : on_air_)
    if (!packets.empty()) next = std::min(next, packets.front().to + FromSeconds(config_.latency_s));
  return next;
}

}  // namespace priamos::bus::radio
