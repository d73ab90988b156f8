#include "test/bus/radio/explorer/explored_run.hpp"

#include <algorithm>

#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {
namespace {

constexpr Duration kAgreement{400'000}, kOffering{1'200'000}, kRecovery{4'000'000};
/// The last part of the recovery, in which commands must come again.
constexpr Duration kRecovered{1'000'000};
constexpr Duration kTick{1000}, kLatency{5000};
constexpr Duration kLateBy{60'000}, kVeryLateBy{700'000}, kAgainAfter{300'000};
constexpr Duration kFull{250'000};
constexpr Time kStart{Duration(1'000'000'000)};
/// When the onboard end is started again with the next key.
constexpr Duration kRekey = kAgreement + Duration(300'000);
constexpr LinkKey kKey{1, 2, 3}, kNextKey{4, 5, 6};

bool Every(Duration since, Duration period, Duration phase) {
  return since % period == phase;
}

Duration DelayBy(Accident accident) {
  return accident == Accident::kLate ? kLateBy : accident == Accident::kVeryLate ? kVeryLateBy : Duration{};
}

}  // namespace

ExploredRun::ExploredRun(ExploredWorld world, std::vector<Mishap> mishaps)
    : world_(world),
      mishaps_(std::move(mishaps)),
      start_(kStart),
      now_(kStart),
      nonces_(Rng::Stream(1, "nonces")) {
  if (world_.rekey) offboard_.next_key = kNextKey;
  Start(onboard_);
  Start(offboard_);
}

std::vector<std::string> ExploredRun::Run() {
  while (now_ < start_ + kAgreement + kOffering + kRecovery) Tick();
  promises_.Settle(now_ - kRecovered);
  for (const End* end : {&onboard_, &offboard_})
    if (world_.rekey) promises_.OnKeyChange(end->link->Status(now_).key_change, end->outgoing);
  return promises_.broken();
}

/// Notes a place; returns the accident that happens there, or null.
const Accident* ExploredRun::AccidentHere(PlaceKind kind) {
  if (!Exploring()) return nullptr;
  places_.push_back(kind);
  const auto found = std::find_if(mishaps_.begin(), mishaps_.end(),
                                  [&](const Mishap& m) { return m.place == places_.size() - 1; });
  return found == mishaps_.end() ? nullptr : &found->accident;
}

bool ExploredRun::Exploring() const {
  return now_ >= start_ + kAgreement && now_ < start_ + kAgreement + kOffering;
}

void ExploredRun::Start(End& end) {
  LinkOptions options;
  options.datagrams = world_.datagrams;
  options.packet_overhead = world_.packet_overhead;
  end.link = std::make_unique<LinkEndpoint>(
      ChannelTable(TestChannels(), false), end.outgoing, kKey, options, end.store,
      [](std::size_t, std::span<const std::byte> encoded, Time) {
        return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
      },
      [this] { return nonces_.engine()(); }, now_, end.next_key);
}

void ExploredRun::Fail(End& end, Accident accident) {
  if (accident == Accident::kDiskFull) {
    end.store.SetFull(true);
    end.full_until = now_ + kFull;
    return;
  }
  // A disk that is full when its end fails is so no more when that starts again; what it holds is older.
  const bool was_full = end.store.full();
  end.store.SetFull(false);
  end.full_until.reset();
  if (accident == Accident::kStopped) end.link->Close();
  end.link.reset();
  end.frame.clear();
  if (accident == Accident::kPowerLost || accident == Accident::kPowerLostLate)
    end.store.LosePower(accident == Accident::kPowerLostLate);
  if (accident == Accident::kEmptied) end.store.LoseEverything();
  if (accident == Accident::kPutBack) end.store.PutBack();
  if (was_full || (accident != Accident::kStopped && accident != Accident::kKilled)) promises_.OnMemoryLost();
  Start(end);
}

void ExploredRun::FreeDisk(End& end) {
  if (end.full_until && now_ >= *end.full_until) Fail(end, Accident::kKilled);
}

void ExploredRun::Tick() {
  now_ += kTick;
  if (now_ < start_ + kAgreement + kOffering + kRecovery - Duration(500'000)) Offer();
  if (world_.rekey && now_ - start_ == kRekey) {
    onboard_.next_key = kNextKey;
    Fail(onboard_, Accident::kStopped);
  }
  FreeDisk(onboard_);
  FreeDisk(offboard_);
  Send(onboard_, offboard_);
  Send(offboard_, onboard_);
  if (Every(now_ - start_, world_.end_places_every, Duration{})) {
    for (End* end : {&onboard_, &offboard_})
      if (const Accident* accident = AccidentHere(PlaceKind::kEnd)) Fail(*end, *accident);
  }
  Receive(onboard_);
  Receive(offboard_);
}

void ExploredRun::Offer() {
  const Duration since = now_ - start_;
  if (Every(since, Duration(100'000), Duration(3000))) OfferTo(onboard_, kPoseUp, 10);
  if (Every(since, Duration(50'000), Duration(7000))) OfferTo(offboard_, kDriveDown, 5);
  if (since <= kAgreement) return;
  // While accidents happen densely, then now and then.
  const bool densely = Exploring();
  if (Every(since, Duration(densely ? 130'000 : 700'000), Duration(11'000))) OfferTo(offboard_, kStopDown, 1);
  if (Every(since, Duration(densely ? 400'000 : 900'000), Duration(13'000)))
    OfferTo(offboard_, kEventDown, 60);
  if (Every(since, Duration(densely ? 300'000 : 800'000), Duration(17'000))) OfferTo(onboard_, kEventUp, 30);
}

void ExploredRun::OfferTo(End& end, std::size_t channel, std::size_t size) {
  const auto message = promises_.NextMessage(channel, size, now_);
  if (end.link->Offer(channel, message, now_) != OfferResult::kAccepted) promises_.OnRefused(channel);
}

void ExploredRun::Send(End& from, End& to) {
  for (const std::byte b : from.link->Step(now_)) {
    from.frame.push_back(b);
    if (b == kDelimiter) EndFrame(from, to);
  }
}

void ExploredRun::EndFrame(End& from, End& to) {
  const std::vector<std::byte> frame = std::exchange(from.frame, {});
  const auto state = from.store.newest();
  const auto saved = state ? ParseLinkState(*state) : std::nullopt;
  const bool changed = saved && saved->key_check == KeyCheck(kNextKey);
  promises_.OnFrame(std::span(frame).first(frame.size() - 1), from.outgoing, saved ? saved->epoch : 0,
                    changed ? kNextKey : kKey);
  const Accident* accident = AccidentHere(PlaceKind::kFrame);
  if (accident != nullptr && *accident == Accident::kLost) return;
  const Duration air = world_.packet_overhead > Duration::zero()
                           ? world_.packet_overhead +
                                 FromSeconds(static_cast<double>(frame.size()) / LinkOptions{}.bytes_per_s)
                           : Duration::zero();
  Time arrival = now_ + air + kLatency + (accident != nullptr ? DelayBy(*accident) : Duration{});
  if (!world_.datagrams) arrival = to.last_arrival = std::max(to.last_arrival, arrival);
  to.arriving.emplace(arrival, frame);
  if (accident != nullptr && *accident == Accident::kTwice) to.arriving.emplace(arrival + kAgainAfter, frame);
}

void ExploredRun::Receive(End& end) {
  while (!end.arriving.empty() && end.arriving.begin()->first <= now_) {
    const auto frame = std::move(end.arriving.extract(end.arriving.begin()).mapped());
    const std::uint64_t accepted = end.link->Status(now_).counters.frames_received;
    for (const Delivery& delivery : Take(*end.link, frame))
      promises_.OnDelivery(delivery, Opposite(end.outgoing), now_);
    if (end.link->Status(now_).counters.frames_received > accepted)
      promises_.OnAccepted(frame, Opposite(end.outgoing));
  }
}

std::vector<Delivery> ExploredRun::Take(LinkEndpoint& link, std::span<const std::byte> frame) const {
  if (!world_.datagrams) return link.Receive(frame, now_);
  return link.ReceiveFrame(frame.first(frame.size() - 1), now_, now_, false).deliveries;
}

}  // namespace priamos::bus::radio
