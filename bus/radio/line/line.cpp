#include "bus/radio/line/line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr std::int64_t ToNs(Time t) {
  return ToUtime(t) * 1000;
}
constexpr std::int64_t SecondsToNs(double s) {
  return static_cast<std::int64_t>(s * 1e9);
}

}  // namespace

void LineCut::Describe(Archive& a) {
  a.Number("from_s", from_s, {"s", 0, 1e6, "the line dies this long after its start"});
  a.Number("to_s", to_s, {"s", 0, 1e6, "and lives again from here on"});
  if (to_s < from_s) a.Refuse("to_s", "a time not before from_s");
}

void LineDelay::Describe(Archive& a) {
  a.Choice("way", way, {"a_to_b", "b_to_a", "both"}, "which direction");
  a.Number("from_s", from_s, {"s", 0, 1e6, "from so long after the start of the line"});
  a.Number("to_s", to_s, {"s", 0, 1e6, "until then"});
  a.Number("first_s", first_s, {"s", 0, 1000, "added to the latency in the beginning"});
  a.Number("last_s", last_s, {"s", 0, 1000, "and in the end; in between it changes evenly"});
  if (to_s <= from_s) a.Refuse("to_s", "a time after from_s");
}

void LineConfig::Describe(Archive& a) {
  a.Integer("baud", baud, {"baud", 300, 1000000, "10 bits per byte"});
  a.Number("air_rate_bytes_s", air_rate_bytes_s,
           {"byte/s", 0, 1e6, "what the radio itself carries when that is less; 0: as much as the port"});
  a.Number("latency_s", latency_s, {"s", 0, 10, "delay of every byte"});
  a.Number("jitter_s", jitter_s, {"s", 0, 10, "uniform addition to the latency"});
  a.Number("bit_error_rate", bit_error_rate, {"-", 0, 0.5, "probability of a flip per bit"});
  a.Number("burst_rate_hz", burst_rate_hz, {"1/s", 0, 1000, "error bursts per second"});
  a.Number("burst_length_s", burst_length_s, {"s", 0, 10, "length of one burst"});
  a.Number("burst_error_rate", burst_error_rate, {"-", 0, 0.5, "bit error rate inside a burst"});
  a.Number("duplicate_probability", duplicate_probability, {"-", 0, 1, "a byte arrives twice"});
  a.Flag("half_duplex", half_duplex, "a modem hears nothing while it sends");
  a.Number("turnaround_s", turnaround_s, {"s", 0, 1, "half-duplex: nor for so long afterwards"});
  a.List("cut", cuts, "times without a line");
  a.List("delay", delays, "times with more delay: steps, ramps and stalls");
}

void SharedAir::Sends(int side, std::int64_t from_ns, std::int64_t to_ns) {
  auto& spans = spans_[side];
  constexpr std::int64_t kMemory_ns = 30'000'000'000;
  while (!spans.empty() && spans.front().to_ns < from_ns - kMemory_ns) spans.pop_front();
  if (!spans.empty() && spans.back().to_ns >= from_ns) {
    spans.back().to_ns = to_ns;
  } else {
    spans.push_back({from_ns, to_ns});
  }
}

bool SharedAir::IsDeaf(int side, std::int64_t from_ns, std::int64_t to_ns) const {
  const auto& spans = spans_[static_cast<std::size_t>(side)];
  return std::any_of(spans.begin(), spans.end(),
                     [&](const Span& s) { return from_ns < s.to_ns + turnaround_ns_ && to_ns > s.from_ns; });
}

bool SharedAir::IsJammed(int sender, int receiver, std::int64_t from_ns, std::int64_t to_ns) const {
  for (int side = 0; side < static_cast<int>(spans_.size()); ++side) {
    if (side == sender || side == receiver) continue;
    for (const Span& s : spans_[static_cast<std::size_t>(side)])
      if (from_ns < s.to_ns && to_ns > s.from_ns) return true;
  }
  return false;
}

LinePair::LinePair(const LineConfig& config, Rng rng_a, Rng rng_b, Time start)
    : air(config.half_duplex ? std::make_shared<SharedAir>(config.turnaround_s) : nullptr),
      a_to_b(config, rng_a, start, air, 0),
      b_to_a(config, rng_b, start, air, 1) {}

Line::Line(const LineConfig& config, Rng rng, Time start) : Line(config, rng, start, nullptr, 0) {}

Line::Line(const LineConfig& config, Rng rng, Time start, std::shared_ptr<SharedAir> air, int side)
    : Line(config, rng, start, std::move(air), side, 1 - side) {}

Line::Line(const LineConfig& config, Rng rng, Time start, std::shared_ptr<SharedAir> air, int side,
           int receiver)
    : config_(config),
      rng_(rng),
      start_ns_(ToNs(start)),
      byte_ns_(10'000'000'000 / config.baud),
      air_byte_ns_(config.air_rate_bytes_s > 0 ? SecondsToNs(1 / config.air_rate_bytes_s) : 0),
      free_at_ns_(start_ns_),
      air_free_at_ns_(start_ns_),
      last_arrival_ns_(start_ns_),
      air_(std::move(air)),
      side_(side),
      receiver_(receiver) {
  std::erase_if(config_.delays,
                [&](const LineDelay& d) { return d.way == (side_ == 0 ? "b_to_a" : "a_to_b"); });
  std::sort(config_.cuts.begin(), config_.cuts.end(),
            [](const LineCut& a, const LineCut& b) { return a.from_s < b.from_s; });
  if (config_.burst_rate_hz > 0)
    burst_start_ns_ =
        start_ns_ + SecondsToNs(std::exponential_distribution<>(config_.burst_rate_hz)(rng_.engine()));
}

void Line::Write(std::span<const std::byte> bytes, Time now) {
  for (const std::byte byte : bytes) {
    free_at_ns_ = std::max(free_at_ns_, ToNs(now)) + byte_ns_;
    // A slower radio begins with a byte when it has all of it.
    const std::int64_t length_ns = air_byte_ns_ > byte_ns_ ? air_byte_ns_ : byte_ns_;
    air_free_at_ns_ =
        length_ns == byte_ns_ ? free_at_ns_ : std::max(air_free_at_ns_, free_at_ns_) + length_ns;
    if (air_) air_->Sends(side_, air_free_at_ns_ - length_ns, air_free_at_ns_);
    Transmit(byte, air_free_at_ns_);
  }
}

std::vector<std::byte> Line::Read(Time now) {
  std::vector<std::byte> bytes;
  while (!arrivals_.empty() && arrivals_.front().at_ns <= ToNs(now)) {
    const std::int64_t at_ns = arrivals_.front().at_ns;
    std::byte byte = arrivals_.front().byte;
    arrivals_.pop_front();
    if (air_ && air_->IsDeaf(receiver_, at_ns - byte_ns_, at_ns)) continue;
    // Two at once: what arrives is neither.
    const std::int64_t sent_ns = at_ns - SecondsToNs(config_.latency_s);
    if (air_ && air_->IsJammed(side_, receiver_, sent_ns - byte_ns_, sent_ns))
      byte ^= static_cast<std::byte>(1 + rng_.engine()() % 255);
    bytes.push_back(byte);
  }
  return bytes;
}

Time Line::next_arrival() const {
  // Rounded up: at the returned time the byte is there.
  return arrivals_.empty() ? Time::max() : Time(Duration((arrivals_.front().at_ns + 999) / 1000));
}

void Line::Transmit(std::byte byte, std::int64_t end_ns) {
  const double rate = BitErrorRate(end_ns);
  unsigned flips = 0;  // bit 0 start, 1..8 data, 9 stop
  if (rate > 0 && rng_.Chance(1 - std::pow(1 - rate, 10))) {
    // At least one of the ten: drawn until it is so, which is the conditional distribution.
    while (flips == 0)
      for (int bit = 0; bit < 10; ++bit) flips |= rng_.Chance(rate) ? 1U << bit : 0U;
  }
  const bool twice = config_.duplicate_probability > 0 && rng_.Chance(config_.duplicate_probability);
  if (Cut(end_ns) || (flips & 1U) != 0) return;
  byte ^= static_cast<std::byte>((flips >> 1) & 0xFF);
  if ((flips & 0x200U) != 0) byte = std::byte{0};
  Arrive(byte, end_ns);
  if (twice) Arrive(byte, end_ns);
}

bool Line::Cut(std::int64_t at_ns) {
  const auto& cuts = config_.cuts;
  while (next_cut_ < cuts.size() && at_ns >= start_ns_ + SecondsToNs(cuts[next_cut_].to_s)) ++next_cut_;
  return next_cut_ < cuts.size() && at_ns >= start_ns_ + SecondsToNs(cuts[next_cut_].from_s);
}

double Line::BitErrorRate(std::int64_t at_ns) {
  const std::int64_t length_ns = SecondsToNs(config_.burst_length_s);
  while (config_.burst_rate_hz > 0 && at_ns >= burst_start_ns_ + length_ns)
    burst_start_ns_ +=
        length_ns + SecondsToNs(std::exponential_distribution<>(config_.burst_rate_hz)(rng_.engine()));
  return at_ns >= burst_start_ns_ ? config_.burst_error_rate : config_.bit_error_rate;
}

std::int64_t Line::AddedDelay(std::int64_t at_ns) const {
  const double at_s = static_cast<double>(at_ns - start_ns_) / 1e9;
  double added_s = 0;
  for (const LineDelay& d : config_.delays)
    if (at_s >= d.from_s && at_s < d.to_s)
      added_s += d.first_s + (d.last_s - d.first_s) * (at_s - d.from_s) / (d.to_s - d.from_s);
  return SecondsToNs(added_s);
}

void Line::Arrive(std::byte byte, std::int64_t end_ns) {
  const double jitter_s = config_.jitter_s > 0 ? rng_.Uniform(0, config_.jitter_s) : 0;
  last_arrival_ns_ =
      std::max(last_arrival_ns_, end_ns + SecondsToNs(config_.latency_s + jitter_s) + AddedDelay(end_ns));
  arrivals_.push_back({last_arrival_ns_, byte});
}

}  // namespace priamos::bus::radio
