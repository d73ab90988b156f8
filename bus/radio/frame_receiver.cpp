#include "bus/radio/frame_receiver.hpp"

#include <utility>

#include "bus/radio/frame/forgery.hpp"

namespace priamos::bus::radio {
namespace {

/// One COBS code byte before the longest content but its code.
constexpr std::size_t kMaxEncodedBytes = 1 + 1 + kWholeCounterBytes + kMaxBundleBytes;
/// Number of unusable frames in a row that noise alone does not explain.
constexpr std::uint64_t kUnusableAfter = 3;

}  // namespace

FrameReceiver::FrameReceiver(const FrameKeys& keys, Direction incoming, FrameScope scope, double bytes_per_s,
                             Duration silence, Time now)
    : splitter_(kMaxEncodedBytes + scope.code_bytes),
      opener_(keys, incoming, scope),
      guard_(TriesPerSecond(bytes_per_s, scope.code_bytes), now),
      silence_(silence),
      first_byte_(now) {}

void FrameReceiver::SetEpoch(std::uint64_t epoch, std::uint64_t floor) {
  opener_.SetEpoch(epoch, floor);
  newest_.reset();
}

FrameReceiver::Result FrameReceiver::Push(std::byte byte, Time now, std::uint64_t newest_sent) {
  ++counters_.bytes;
  if (splitter_.between_frames()) first_byte_ = now;
  switch (splitter_.Push(byte)) {
    case FrameSplitter::Event::kFrame:
      return OnFrame(now, newest_sent);
    case FrameSplitter::Event::kOversize:
      return OnReject(Reject::kOversize, now);
    case FrameSplitter::Event::kNone:
      break;
  }
  return {};
}

FrameReceiver::Result FrameReceiver::OnFrame(Time now, std::uint64_t newest_sent) {
  if (!guard_.MayTry(now)) return OnReject(Reject::kFlood, now);
  const std::uint64_t highest_before = opener_.highest();
  Opened opened = opener_.Open(splitter_.frame(), newest_sent);
  if (const auto* reject = std::get_if<Reject>(&opened)) return OnReject(*reject, now);
  if (const auto* hello = std::get_if<Hello>(&opened)) return *hello;
  return Accept(std::get<DataFrame>(std::move(opened)), highest_before, now);
}

AcceptedFrame FrameReceiver::Accept(DataFrame frame, std::uint64_t highest_before, Time now) {
  AcceptedFrame accepted{.frame = std::move(frame),
                         .ahead = 0,
                         .wire_bytes = splitter_.frame().size() + 1,
                         .first_byte = first_byte_,
                         .link_back = Down(now)};
  if (accepted.frame.counter > highest_before) accepted.ahead = accepted.frame.counter - highest_before;
  // After its own start an end cannot know what it missed.
  const std::uint64_t missed = heard_at_ && accepted.ahead > 0 ? accepted.ahead - 1 : 0;
  counters_.missed += missed;
  ++counters_.frames;
  guard_.OnMissed(missed);
  loss_.OnFrame(missed, accepted.wire_bytes);
  heard_at_ = now;
  if (accepted.ahead > 0) newest_ = HeardFrame{accepted.frame.counter, now};
  unusable_ = 0;
  return accepted;
}

FrameReceiver::Result FrameReceiver::OnReject(Reject reject, Time now) {
  ++counters_.rejected[static_cast<std::size_t>(reject)];
  if (reject == Reject::kBadCode || reject == Reject::kReplayed) ++unusable_;
  if (reject == Reject::kBadCode) guard_.OnBadCode(now);
  if (reject == Reject::kReplayed) guard_.OnReplay(now);
  return {};
}

Reception FrameReceiver::reception(Time now) const {
  const bool down = Down(now);
  if (opener_.epoch() == 0 || (down && unusable_ >= kUnusableAfter)) return Reception::kUnusable;
  return down ? Reception::kSilent : Reception::kHeard;
}

}  // namespace priamos::bus::radio
