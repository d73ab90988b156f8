#include "link_world.hpp"

#include <algorithm>
#include <bit>
#include <optional>

namespace priamos::bus::radio {
namespace {

constexpr std::uint8_t kRefused = 0xFF;    // a message that begins so cannot be packed
constexpr std::uint8_t kSaturated = 0xFE;  // likewise one that is outside its range
constexpr std::size_t kRememberedFrames = 200;

LinkChannel Channel(std::string name, Direction direction, ChannelClass channel_class, std::uint32_t bits,
                    int priority, double rate_hz) {
  LinkChannel c;
  c.name = std::move(name);
  c.direction = direction;
  c.channel_class = channel_class;
  c.fixed_bits = bits;
  c.max_bits = bits > 0 ? bits : 8 * (channel_class == ChannelClass::kEvent ? 1400 : 150);
  c.priority = priority;
  c.rate_hz = rate_hz;
  if (channel_class == ChannelClass::kCommand) c.ttl = Duration(250'000);
  return c;
}

/// Every class and every option of a channel, both ways.
std::vector<LinkChannel> ChannelsOf(Direction d) {
  std::vector<LinkChannel> channels{Channel("POSE", d, ChannelClass::kState, 40, 2, 10),
                                    Channel("TEXT", d, ChannelClass::kState, 0, 6, 2),
                                    Channel("KEYED", d, ChannelClass::kState, 160, 4, 2),
                                    Channel("WANTED", d, ChannelClass::kState, 800, 7, 1),
                                    Channel("HORN", d, ChannelClass::kState, 16, 0, 0),
                                    Channel("DRIVE", d, ChannelClass::kCommand, 21, 1, 20),
                                    Channel("ADVICE", d, ChannelClass::kCommand, 0, 3, 2),
                                    Channel("STOP", d, ChannelClass::kEvent, 8, 0, 2),
                                    Channel("FLAG", d, ChannelClass::kEvent, 13, 3, 4),
                                    Channel("REPORT", d, ChannelClass::kEvent, 0, 5, 0.5)};
  channels[0].delta = {16, 8, 8, 3, 5};
  channels[0].ttl = Duration(500'000);
  channels[1].burst = 3;
  channels[2].max_keys = 3;
  channels[3].on_request = true;
  channels[3].delta = ValueWidths(50, 16);
  channels[4].urgent = channels[7].urgent = true;
  channels[6].ttl = Duration(1'000'000);
  channels[8].burst = 4;
  return channels;
}

ChannelTable TableOf(bool encrypted, bool another) {
  std::vector<LinkChannel> channels = ChannelsOf(Direction::kUp);
  for (LinkChannel& c : ChannelsOf(Direction::kDown)) channels.push_back(std::move(c));
  if (another) channels[2].fixed_bits = 168;
  return {std::move(channels), encrypted};
}

LinkKey KeyOf(bool another) {
  return {1, another ? std::uint8_t{3} : std::uint8_t{2}};
}

/// The message itself; its second byte becomes the time of packing, as that of a time stamp would.
std::optional<Packed> Pack(const ChannelTable& table, std::size_t channel, std::span<const std::byte> encoded,
                           Time now) {
  const auto first = std::to_integer<std::uint8_t>(encoded[0]);
  if (first == kRefused) return std::nullopt;
  const LinkChannel& c = table.at(channel);
  Packed packed{.bytes = {encoded.begin(), encoded.end()},
                .bits = c.fixed_bits > 0 ? c.fixed_bits : 8 * encoded.size(),
                .saturated = first == kSaturated};
  if (c.delta.empty() && packed.bytes.size() > 2)
    packed.bytes[1] = static_cast<std::byte>(ToUtime(now) / 1000 & 0xFF);
  return packed;
}

}  // namespace

void Path::Write(std::span<const std::byte> bytes, Time now) {
  for (const std::byte b : bytes) {
    // A frame is lost or not when its first byte leaves.
    if (frame_.empty()) lost_ = rng_.Chance(world_.frame_loss);
    frame_.push_back(b);
    if (!lost_ && !world_.options.datagrams) line_.Write(std::span(&b, 1), now);
    if (b == kDelimiter) EndFrame(now);
  }
}

void Path::EndFrame(Time now) {
  const int copies = lost_ ? 0 : rng_.Chance(0.02) ? 2 : 1;
  for (int i = 0; world_.options.datagrams && i < copies; ++i)
    datagrams_.emplace(now + FromSeconds(world_.line.latency_s + rng_.Uniform(0, world_.datagram_jitter_s)),
                       frame_);
  frames_.push_back(std::move(frame_));
  if (frames_.size() > kRememberedFrames) frames_.pop_front();
  frame_.clear();
}

std::vector<std::byte> Path::Read(Time now) {
  if (!world_.options.datagrams) return line_.Read(now);
  std::vector<std::byte> bytes;
  while (!datagrams_.empty() && datagrams_.begin()->first <= now) {
    bytes.insert(bytes.end(), datagrams_.begin()->second.begin(), datagrams_.begin()->second.end());
    datagrams_.erase(datagrams_.begin());
  }
  return bytes;
}

WorldRun::WorldRun(const World& world, std::uint64_t seed)
    : world_(world),
      now_(FromUtime(1'000'000'000)),
      offers_(Rng::Stream(seed, "offers")),
      accidents_(Rng::Stream(seed, "accidents")),
      attacks_(Rng::Stream(seed, "attacks")),
      nonces_(Rng::Stream(seed, "nonces")),
      lines_(world.line, Rng::Stream(seed, "line up"), Rng::Stream(seed, "line down"), now_),
      up_(world_, lines_.a_to_b, Rng::Stream(seed, "path up")),
      down_(world_, lines_.b_to_a, Rng::Stream(seed, "path down")),
      onboard_{Direction::kUp, TracedStore(trace_)},
      offboard_{Direction::kDown, TracedStore(trace_)} {
  Start(onboard_);
  Start(offboard_);
}

void WorldRun::Start(End& end) {
  const bool other = end.outgoing == Direction::kDown;
  const ChannelTable table = TableOf(world_.encrypted, other && world_.tables_differ);
  end.link = std::make_unique<LinkEndpoint>(
      table, end.outgoing, KeyOf(other && world_.keys_differ), world_.options, end.store,
      [table](std::size_t channel, std::span<const std::byte> encoded, Time now) {
        return Pack(table, channel, encoded, now);
      },
      [this] { return nonces_.engine()(); }, now_);
}

void WorldRun::Restart(End& end) {
  if (accidents_.Chance(world_.orderly)) end.link->Close();
  end.link.reset();
  if (accidents_.Chance(world_.forgets)) end.store.Lose();
  if (accidents_.Chance(world_.rollbacks)) end.store.RollBack();
  Start(end);
}

void WorldRun::Run() {
  const Time end = now_ + FromSeconds(world_.seconds);
  Time next_note = now_;
  while (now_ < end) {
    Tick();
    if (now_ < next_note) continue;
    next_note += Duration(500'000);
    Note(onboard_);
    Note(offboard_);
  }
}

void WorldRun::Tick() {
  step_ = Duration(1000 + 100 * accidents_.Below(11));
  if (Happens(accidents_, world_.stalls_hz)) step_ = Duration(20'000 + accidents_.Below(280'000));
  now_ += step_;
  for (End* end : {&onboard_, &offboard_}) {
    Offer(*end);
    Listen(*end);
    if (Happens(accidents_, world_.restarts_hz)) Restart(*end);
    if (Happens(attacks_, world_.hostile_hz)) Take(*end, Forged(*end));
    if (Happens(attacks_, world_.insider_hz)) Take(*end, Nonsense(Other(*end)));
  }
  Move(onboard_, up_);
  Move(offboard_, down_);
  Take(onboard_, down_.Read(now_));
  Take(offboard_, up_.Read(now_));
}

void WorldRun::Offer(End& end) {
  const ChannelTable& table = end.link->table();
  for (std::size_t i = 0; i < table.size(); ++i) {
    const LinkChannel& c = table.at(i);
    if (c.direction != end.outgoing) continue;
    if (!Happens(offers_, c.urgent ? world_.stops_hz : 1.1 * world_.load * c.rate_hz)) continue;
    const std::string key = c.max_keys > 1 ? std::to_string(offers_.Below(4)) : "";
    trace_.Number(static_cast<std::uint64_t>(end.link->Offer(i, Message(end, c), now_, key)));
  }
}

std::vector<std::byte> WorldRun::Message(End& end, const LinkChannel& c) {
  std::size_t size = (c.fixed_bits + 7) / 8;
  if (c.fixed_bits == 0) size = 3 + offers_.Below(offers_.Chance(0.1) ? (c.max_bits / 8 - 3) : 60);
  std::vector<std::byte> message(size);
  for (std::byte& b : message) b = static_cast<std::byte>(offers_.Below(256));
  if (c.fixed_bits % 8 != 0) message.back() &= static_cast<std::byte>(0xFF << (8 - c.fixed_bits % 8));
  if (c.delta.empty()) return message;
  // A slow walk, seldom a jump: short differences, long ones and none.
  end.walk += offers_.Chance(0.1) ? offers_.Below(5000) : offers_.Below(3);
  for (std::size_t i = 0; i < size; ++i)
    message[i] = static_cast<std::byte>(i % 2 == 0 ? 0x21 : end.walk & 0xFF);
  message[0] = static_cast<std::byte>(end.walk >> 8 & 0xFF);
  return message;
}

void WorldRun::Listen(End& end) {
  if (!Happens(offers_, 0.3)) return;
  const ChannelTable& table = end.link->table();
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table.at(i).on_request && table.at(i).direction != end.outgoing)
      end.link->Listen(i, offers_.Chance(0.6));
}

void WorldRun::Move(End& end, Path& path) {
  const std::vector<std::byte> bytes = end.link->Step(now_);
  if (bytes.empty()) return;
  trace_.Number(static_cast<std::uint64_t>(ToUtime(now_)));
  trace_.Bytes(bytes);
  path.Write(bytes, now_);
}

void WorldRun::Take(End& end, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  for (const Delivery& d : end.link->Receive(bytes, now_)) {
    trace_.Number(d.channel);
    trace_.Bytes(d.packed);
    trace_.Number(static_cast<std::uint64_t>(ToUtime(d.packed_at)));
    trace_.Number(d.valid_until ? static_cast<std::uint64_t>(ToUtime(*d.valid_until)) : 0);
    ++delivered_[end.link->table().at(d.channel).channel_class];
  }
}

std::vector<std::byte> WorldRun::Forged(const End& end) {
  const bool reflected = attacks_.Chance(0.2);
  const Path& path = (end.outgoing == Direction::kUp) != reflected ? down_ : up_;
  std::vector<std::byte> frame(5 + attacks_.Below(60));
  for (std::byte& b : frame) b = static_cast<std::byte>(attacks_.Below(256));
  const auto any = [&] { return path.frames()[attacks_.Below(path.frames().size())]; };
  if (!path.frames().empty() && attacks_.Chance(0.9)) frame = any();
  if (!path.frames().empty() && attacks_.Chance(0.2)) {
    const auto other = any();
    frame.resize(attacks_.Below(frame.size() + 1));
    frame.insert(frame.end(), other.begin() + static_cast<std::ptrdiff_t>(attacks_.Below(other.size())),
                 other.end());
  }
  for (std::uint64_t n = attacks_.Chance(0.5) ? attacks_.Below(4) : 0; n > 0 && !frame.empty(); --n)
    frame[attacks_.Below(frame.size())] = static_cast<std::byte>(attacks_.Below(256));
  frame.push_back(kDelimiter);
  return frame;
}

std::vector<std::byte> WorldRun::Nonsense(End& sender) {
  const auto state = ParseLinkState(sender.store.Load().value_or(SavedState{}).bytes);
  if (!state || state->epoch == 0) return {};
  std::vector<std::byte> bundle(1 + attacks_.Below(60));
  for (std::byte& b : bundle) b = static_cast<std::byte>(attacks_.Below(256));
  const ChannelTable& table = sender.link->table();
  const FrameSealer sealer(FrameKeys(KeyOf(false)), sender.outgoing, {table.hash(), table.encrypted()});
  return sealer.Seal(state->epoch, state->send_next + attacks_.Below(300), CounterForm::kWhole, bundle);
}

void WorldRun::Note(const End& end) {
  const LinkStatus s = end.link->Status(now_);
  const LinkCounters& c = s.counters;
  for (const bool flag : {s.up, s.agreed, s.alarm, s.table_mismatch}) trace_.Number(flag ? 1 : 0);
  for (const Duration d : {s.round_trip, s.latency}) trace_.Number(static_cast<std::uint64_t>(d.count()));
  for (const double v : {s.loss, s.peer_loss, s.bit_error_rate})
    trace_.Number(std::bit_cast<std::uint64_t>(v));
  for (const std::uint64_t n :
       {s.resent, c.bytes_sent, c.bytes_received, c.bundle_bytes_sent, c.frames_sent, c.frames_aborted,
        c.frames_received, c.frames_missed, c.hellos_sent, c.hellos_received, c.bundles_damaged})
    trace_.Number(n);
  for (const std::uint64_t n : c.rejected) trace_.Number(n);
  for (std::size_t i = 0; i < end.link->table().size(); ++i) {
    const QueueCounters& q = end.link->sent(i);
    const DeliveryCounters& d = end.link->delivered(i);
    for (const std::uint64_t n :
         {q.offered, q.sent, q.replaced, q.expired, q.refused, q.unwanted, q.saturated, q.bits, d.delivered,
          d.late, d.bits, std::uint64_t{end.link->waiting(i)}})
      trace_.Number(n);
    trace_.Number(end.link->wanted(i) ? 1 : 0);
    trace_.Number(static_cast<std::uint64_t>(end.link->OldestAge(i, now_).count()));
  }
}

}  // namespace priamos::bus::radio
