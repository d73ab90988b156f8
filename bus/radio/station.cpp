#include "bus/radio/station.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {
namespace {

/// Polls of a robot that has not acknowledged an urgent message, which need not wait for kAskEvery.
constexpr int kAskedAtOnce = 2;
/// Polls of such a robot until which the message is sent before every poll; then in its polls alone.
constexpr int kMostSpoken = 12;

}  // namespace

Station::Station(SharedChannel channel, std::vector<LinkEndpoint*> ends)
    : ends_(std::move(ends)),
      urgency_(ends_.size()),
      cycle_(channel, static_cast<std::uint8_t>(ends_.size())) {}

std::vector<std::byte> Station::Step(Time now) {
  // After this process stood still an answer may wait to be read.
  cycle_.Step(looked_ ? std::min(now, *looked_) : now);
  const bool chosen = !granted_ && Choose(now);
  std::vector<std::byte> out;
  // Also those that are silent: they drop what has become too old, and write down what they must.
  for (LinkEndpoint* const end : ends_) {
    const std::vector<std::byte> bytes = end->Step(now);
    out.insert(out.end(), bytes.begin(), bytes.end());
  }
  if (!granted_) return out;
  TurnTaking& turns = ends_[granted_->robot]->turns();
  if (chosen && out.empty()) {
    // It may not say hello so soon again, or its urgent message cannot be packed: the turn is the next one's.
    turns.Revoke();
    urgency_[granted_->robot].fruitless = true;
    granted_.reset();
  } else if (!turns.mine()) {
    OnFrameSent(now);
  }
  return out;
}

/// Whether an end may send a frame from now on.
bool Station::Choose(Time now) {
  if (!cycle_.MayTalk(now) || now < line_free_) return false;
  std::size_t robot = FirstToSpeak(now);
  const bool poll = robot == ends_.size();
  if (poll) robot = NextPoll(now);
  granted_ = {.robot = robot, .poll = poll};
  urgency_[robot].spoken = true;
  ends_[robot]->turns().Grant(now, poll);
  return true;
}

/// What is new goes before what is repeated, maybe to a robot that is not there.
std::size_t Station::FirstToSpeak(Time now) const {
  std::size_t first = ends_.size();
  for (std::size_t i = ends_.size(); i-- > 0;) {
    if (!MaySpeak(i, now)) continue;
    if (ends_[i]->need(now) == Need::kUrgent) return i;
    first = i;
  }
  return first;
}

bool Station::MaySpeak(std::size_t robot, Time now) const {
  const Urgency& u = urgency_[robot];
  if (u.fruitless) return false;
  const Need need = ends_[robot]->need(now);
  return need == Need::kUrgent || (need == Need::kAnswer && !u.spoken && u.asks < kMostSpoken);
}

/// A robot that has to be asked goes before those in turn, so often that nobody starves.
std::size_t Station::NextPoll(Time now) {
  if (const auto asked = FindAsked(now)) return last_asked_ = *asked;
  ++regular_;
  return cycle_.Next() - 1U;
}

std::optional<std::size_t> Station::FindAsked(Time now) {
  for (std::size_t n = 1; n <= ends_.size(); ++n) {
    const std::size_t i = (last_asked_ + n) % ends_.size();
    const Need need = ends_[i]->need(now);
    Urgency& u = urgency_[i];
    if (need != Need::kAnswer) u.asks = 0;
    if (need == Need::kNothing || u.fruitless) continue;
    const bool at_once = need == Need::kAnswer && u.asks < kAskedAtOnce;
    if (!at_once && regular_ < kAskEvery - 1) continue;
    // One that is asked at once takes no turn from those that are asked now and then.
    if (!at_once) regular_ = 0;
    ++u.asks;
    return i;
  }
  return std::nullopt;
}

void Station::OnFrameSent(Time now) {
  const Grant grant = *std::exchange(granted_, std::nullopt);
  line_free_ = std::max(now, ends_[grant.robot]->line_free());
  if (!grant.poll) return;
  for (Urgency& u : urgency_) u.spoken = u.fruitless = false;
  cycle_.OnPollSent(static_cast<std::uint8_t>(grant.robot + 1), line_free_);
}

void Station::Receive(std::span<const std::byte> bytes, Time now,
                      const std::function<void(std::size_t robot, Delivery)>& deliver) {
  if (!bytes.empty()) cycle_.OnBytes();
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    for (Delivery& delivery : ends_[i]->Receive(bytes, now)) deliver(i, std::move(delivery));
    if (cycle_.polled() == i + 1U && ends_[i]->turns().answered()) cycle_.OnAnswer(now);
  }
}

}  // namespace priamos::bus::radio
