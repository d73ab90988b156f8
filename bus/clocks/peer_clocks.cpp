#include "bus/clocks/peer_clocks.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

constexpr std::int64_t kLatest_us = 7'258'118'400'000'000;  // the year 2200
constexpr double kNotKnown_s = 100;                         // of clock_report_t.uncertainty_s
constexpr double kFurthestPeer_s = 100'000;                 // of clock_report_t.ahead_s

bool IsTime(std::int64_t utime) {
  return utime > 0 && utime < kLatest_us;
}

std::uint32_t AddressOf(std::uint64_t sender) {
  return static_cast<std::uint32_t>(sender >> 16);
}

/// False for what no process of ours sends.
bool IsPlausible(const clock_report_t& message) {
  const auto n = static_cast<std::size_t>(std::max<int>(message.count, 0));
  if (!IsTime(message.utime) || message.count < 0 || n > PeerClocks::kMostClocks) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (!IsTime(message.utime_heard[i]) || !IsTime(message.utime_arrived[i])) return false;
  return true;
}

}  // namespace

PeerClocks::Peer* PeerClocks::PeerWithRoom(std::int32_t id, Time now) {
  if (const auto known = peers_.find(id); known != peers_.end()) return &known->second;
  if (peers_.size() >= kMostClocks)
    std::erase_if(peers_, [now](const auto& peer) { return now - peer.second.arrived > kForgotten; });
  return peers_.size() < kMostClocks ? &peers_[id] : nullptr;
}

void PeerClocks::TakeExchange(Peer& peer, const clock_report_t& message, std::size_t i, Time now) const {
  const Time sent = FromUtime(message.utime_heard[i]);
  const bool taken = peer.offset.Add({.sent = sent,
                                      .arrived = FromUtime(message.utime_arrived[i]),
                                      .answered = FromUtime(message.utime),
                                      .heard = now});
  // An exchange that began before may have had the step in its middle.
  if (taken && peer.doubted && sent >= *peer.doubted) Settle(peer, now);
}

void PeerClocks::Settle(Peer& peer, Time now) {
  peer.doubted.reset();
  peer.settled = now;
}

bool PeerClocks::Doubt(std::uint64_t sender, Time now) {
  const auto id = IdOf(sender);
  const auto found = id ? peers_.find(*id) : peers_.end();
  if (found == peers_.end()) return false;
  Peer& peer = found->second;
  if (peer.doubted && std::chrono::abs(now - *peer.doubted) > kDoubt) Settle(peer, now);
  if (!peer.doubted && std::chrono::abs(now - peer.settled) > kDoubt) peer.doubted = now;
  return peer.doubted.has_value();
}

bool PeerClocks::IsCopy(std::uint64_t sender, const clock_report_t& message) const {
  return message.clock_id == own_id_ && !own_addresses_.contains(AddressOf(sender));
}

bool PeerClocks::Hear(std::uint64_t sender, const clock_report_t& message, Time now) {
  if (!IsPlausible(message)) return false;
  if (IsCopy(sender, message)) {
    if (copies_.size() < kMostSenders) copies_[sender] = message.host;
    copy_heard_ = now;
    return false;
  }
  copies_.erase(sender);
  if (by_sender_.size() < kMostSenders || by_sender_.contains(sender)) {
    by_sender_[sender] = message.clock_id;
    by_address_[AddressOf(sender)] = message.clock_id;
  }
  if (message.clock_id == own_id_) return false;
  Peer* peer = PeerWithRoom(message.clock_id, now);
  if (peer == nullptr) return false;
  if (peer->newest_utime == 0) peer->first_heard = now;
  peer->host = message.host;
  peer->newest_utime = message.utime;
  peer->arrived = now;
  double their_uncertainty_s = kNotKnown_s;
  for (std::size_t i = 0; i < static_cast<std::size_t>(message.count); ++i) {
    if (message.heard_id[i] != own_id_) continue;
    TakeExchange(*peer, message, i, now);
    their_uncertainty_s = message.uncertainty_s[i];
  }
  const auto ours = peer->offset.At(now);
  const Duration enough = now - peer->first_heard < kAcquaintance ? kWell : FromSeconds(kNotKnown_s / 2);
  return !(their_uncertainty_s <= Seconds(enough)) || !ours || ours->uncertainty > enough ||
         peer->offset.unsteady() || peer->doubted;
}

std::optional<std::int32_t> PeerClocks::IdOf(std::uint64_t sender) const {
  if (const auto found = by_sender_.find(sender); found != by_sender_.end()) return found->second;
  if (own_addresses_.contains(AddressOf(sender))) return own_id_;
  if (const auto found = by_address_.find(AddressOf(sender)); found != by_address_.end())
    return found->second;
  return std::nullopt;
}

SenderClock PeerClocks::ClockOf(std::uint64_t sender, Time now) const {
  if (const auto copy = copies_.find(sender); copy != copies_.end())
    return {SenderClock::Kind::kCopied, {}, copy->second};
  const auto id = IdOf(sender);
  if (!id) return {};
  if (*id == own_id_) return {SenderClock::Kind::kOurs, {}, ""};
  const auto peer = peers_.find(*id);
  if (peer == peers_.end()) return {};
  const auto difference = peer->second.offset.At(now);
  if (!difference) return {SenderClock::Kind::kUnknown, {}, peer->second.host};
  return {SenderClock::Kind::kKnown, *difference, peer->second.host};
}

std::optional<ClockDifference> PeerClocks::AheadOfReference(Time now) const {
  if (!copies_.empty() && now - copy_heard_ <= kForgotten) return std::nullopt;
  const auto reference = std::find_if(peers_.begin(), peers_.end(), [now](const auto& peer) {
    return now - peer.second.arrived <= kForgotten;
  });
  if (reference == peers_.end() || reference->first > own_id_) return ClockDifference{};
  auto difference = reference->second.offset.At(now);
  if (difference) difference->ahead = -difference->ahead;
  return difference;
}

clock_report_t PeerClocks::Report(Time now) const {
  clock_report_t message{};
  message.utime = ToUtime(now);
  message.clock_id = own_id_;
  for (const auto& [id, peer] : peers_) {
    const auto difference = peer.doubted ? std::nullopt : peer.offset.At(now);
    message.heard_id.push_back(id);
    message.utime_heard.push_back(peer.newest_utime);
    message.utime_arrived.push_back(ToUtime(peer.arrived));
    message.ahead_s.push_back(
        difference ? std::clamp(Seconds(difference->ahead), -kFurthestPeer_s, kFurthestPeer_s) : 0);
    message.uncertainty_s.push_back(difference ? std::min(Seconds(difference->uncertainty), kNotKnown_s)
                                               : kNotKnown_s);
  }
  message.count = static_cast<std::int8_t>(peers_.size());
  return message;
}

}  // namespace priamos::bus
