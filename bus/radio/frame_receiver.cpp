#include "bus/radio/frame_receiver.hpp"

#include <algorithm>
#include <utility>

#include "bus/radio/frame/forgery.hpp"

namespace priamos::bus::radio {
namespace {

/// One COBS code byte before the longest content but its code.
constexpr std::size_t kMaxEncodedBytes = 1 + 1 + kWholeCounterBytes + kMaxBundleBytes;
/// Number of unusable frames in a row that noise alone does not explain.
constexpr std::uint64_t kUnusableAfter = 3;
/// A counter may be so much further than the line can have carried frames: what was cut off has one, too.
constexpr double kCountersAhead = 8;

/// Whether all bytes are symbols of a block. No frame in COBS is: its first byte is small.
bool IsBlock(std::span<const std::byte> encoded) {
  return !encoded.empty() && std::all_of(encoded.begin(), encoded.end(),
                                         [](std::byte b) { return (b & std::byte{0x80}) != std::byte{0}; });
}

}  // namespace

FrameReceiver::FrameReceiver(const FrameKeys& keys, Direction incoming, FrameScope scope, double bytes_per_s,
                             Duration silence, Time now)
    : splitter_(kMaxEncodedBytes + scope.address_bytes() + scope.code_bytes),
      opener_(keys, incoming, scope),
      guard_(TriesPerSecond(bytes_per_s, scope.code_bytes), now),
      silence_(silence),
      first_byte_(now),
      frames_per_s_(bytes_per_s / kFrameOverhead) {}

void FrameReceiver::SetEpoch(std::uint64_t epoch, std::uint64_t floor) {
  opener_.SetEpoch(epoch, floor);
  newest_.reset();
  newest_echo_.reset();
}

void FrameReceiver::UseNextKey() {
  opener_ = *next_opener_;
  next_opener_.reset();
}

FrameReceiver::Result FrameReceiver::Push(std::byte byte, Time now, std::uint64_t newest_sent) {
  ++counters_.bytes;
  if (splitter_.between_frames()) first_byte_ = now;
  auto block = blocks_.Push(byte, now);
  const FrameSplitter::Event event = splitter_.Push(byte);
  if (block) {
    return OnContent({.content = std::move(block->content),
                      .wire_bytes = block->wire_bytes,
                      .first_byte = block->first_byte,
                      .line_code = LineCode::kBlock},
                     now, newest_sent);
  }
  if (event == FrameSplitter::Event::kFrame)
    return OnEncoded(splitter_.frame(), first_byte_, now, newest_sent, false);
  if (event == FrameSplitter::Event::kOversize) return OnReject(Reject::kOversize, now);
  return {};
}

FrameReceiver::Result FrameReceiver::Take(std::span<const std::byte> frame, Time first_byte, Time now,
                                          std::uint64_t newest_sent, bool stranger) {
  if (!stranger) counters_.bytes += frame.size() + 1;
  if (frame.size() > kMaxEncodedBytes) return OnReject(Reject::kOversize, now);
  if (!IsBlock(frame)) return OnEncoded(frame, first_byte, now, newest_sent, stranger);
  // A stream over TCP is a line that was cut at its delimiters: what travels in blocks comes here, too.
  auto content = DecodeBlock(frame);
  if (!content) return OnReject(Reject::kMalformed, now);
  return OnContent({.content = std::move(*content),
                    .wire_bytes = frame.size() + 1,
                    .first_byte = first_byte,
                    .line_code = LineCode::kBlock,
                    .stranger = stranger},
                   now, newest_sent);
}

FrameReceiver::Result FrameReceiver::OnEncoded(std::span<const std::byte> encoded, Time first_byte, Time now,
                                               std::uint64_t newest_sent, bool stranger) {
  auto content = CobsDecode(encoded);
  if (!content) return OnReject(Reject::kMalformed, now);
  return OnContent({.content = std::move(*content),
                    .wire_bytes = encoded.size() + 1,
                    .first_byte = first_byte,
                    .stranger = stranger},
                   now, newest_sent);
}

/// Frames of another robot are none of this end's business, and no sign of noise.
FrameReceiver::Result FrameReceiver::OnContent(Incoming incoming, Time now, std::uint64_t newest_sent) {
  if (!opener_.Addressed(incoming.content)) return {};
  incoming.content.erase(incoming.content.begin(),
                         incoming.content.begin() + static_cast<std::ptrdiff_t>(opener_.address_bytes()));
  return OnFrame(incoming, now, newest_sent);
}

/// What can be seen without a code is looked at first: garbage costs no check of the other end's frames.
FrameReceiver::Result FrameReceiver::OnFrame(const Incoming& incoming, Time now, std::uint64_t newest_sent) {
  const auto head = opener_.Look(incoming.content, newest_sent);
  if (!head) return OnReject(Reject::kMalformed, now);
  const Claim claim = incoming.stranger && !Down(now) ? Claim::kStranger
                      : Expected(*head, now)          ? Claim::kExpected
                                                      : Claim::kOther;
  if (!guard_.MayTry(claim, now)) return OnReject(Reject::kFlood, now);
  const std::uint64_t highest_before = opener_.highest();
  Opened opened = opener_.Open(incoming.content, newest_sent);
  if (head->hello && next_opener_ && std::holds_alternative<Reject>(opened)) {
    const Opened under_next = next_opener_->Open(incoming.content);
    if (const auto* hello = std::get_if<Hello>(&under_next)) return NextKeyHello{*hello};
  }
  if (const auto* reject = std::get_if<Reject>(&opened)) return OnReject(*reject, now);
  if (const auto* hello = std::get_if<Hello>(&opened)) return *hello;
  return Accept(std::get<DataFrame>(std::move(opened)), incoming, highest_before, now);
}

/// Whether the other end can send this next: no further ahead than the line carries, and no echo older than
/// the last one. A hello has a code that nobody guesses.
bool FrameReceiver::Expected(const FrameHead& head, Time now) const {
  if (head.hello || !heard_at_) return true;
  if (head.counter <= opener_.highest()) return false;
  const double reach = kCountersAhead + Seconds(now - *heard_at_) * frames_per_s_;
  if (static_cast<double>(head.counter - opener_.highest()) > reach) return false;
  return !head.echo || !newest_echo_ || *head.echo >= *newest_echo_;
}

AcceptedFrame FrameReceiver::Accept(DataFrame frame, const Incoming& incoming, std::uint64_t highest_before,
                                    Time now) {
  AcceptedFrame accepted{.frame = std::move(frame),
                         .wire_bytes = incoming.wire_bytes,
                         .first_byte = incoming.first_byte,
                         .link_back = Down(now)};
  if (accepted.frame.counter > highest_before) accepted.ahead = accepted.frame.counter - highest_before;
  // After its own start an end cannot know what it missed.
  const std::uint64_t missed = heard_at_ && accepted.ahead > 0 ? accepted.ahead - 1 : 0;
  counters_.missed += missed;
  ++counters_.frames;
  guard_.OnMissed(missed);
  loss_.OnFrame(missed, incoming.wire_bytes);
  heard_at_ = now;
  if (accepted.ahead > 0) newest_ = HeardFrame{accepted.frame.counter, now, incoming.line_code};
  if (accepted.ahead > 0 && accepted.frame.echo) newest_echo_ = accepted.frame.echo;
  unusable_ = malformed_ = 0;
  return accepted;
}

FrameReceiver::Result FrameReceiver::OnReject(Reject reject, Time now) {
  ++counters_.rejected[static_cast<std::size_t>(reject)];
  if (reject == Reject::kBadCode || reject == Reject::kReplayed) ++unusable_;
  if (reject == Reject::kMalformed) ++malformed_;
  if (reject == Reject::kBadCode) guard_.OnBadCode(now);
  if (reject == Reject::kReplayed) guard_.OnReplay(now);
  return {};
}

Reception FrameReceiver::reception(Time now) const {
  const bool down = Down(now);
  // Noise damages the form of more frames than it leaves.
  const bool unusable = unusable_ >= kUnusableAfter && unusable_ > malformed_;
  if (opener_.epoch() == 0 || (down && unusable)) return Reception::kUnusable;
  return down ? Reception::kSilent : Reception::kHeard;
}

}  // namespace priamos::bus::radio
