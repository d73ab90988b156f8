#include "bus/radio/bundle_builder.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus::radio {
namespace {

/// The smallest target when errors are many: one segment of an event and its head.
constexpr std::size_t kSmallestBundle = 60;

bool IsMessage(const BundleEntry& entry) {
  return std::holds_alternative<StateEntry>(entry) || std::holds_alternative<CommandEntry>(entry) ||
         std::holds_alternative<EventEntry>(entry);
}

}  // namespace

std::size_t BestBundleBytes(std::size_t max_bytes, double loss, std::size_t frame_overhead) {
  if (loss <= 0) return max_bytes;
  // Goodput (1 - h / n) (1 - p)^(10 n) of n bytes with h of overhead is largest near n = sqrt(h / (10 p)).
  const double mean = static_cast<double>(max_bytes) / 2;
  const double p = -std::log(1 - std::min(loss, 0.95)) / (10 * mean);
  const double best = std::sqrt(static_cast<double>(frame_overhead) / (10 * p));
  return std::min(max_bytes, std::max(kSmallestBundle, static_cast<std::size_t>(best)));
}

BundleBuilder::BundleBuilder(const ChannelTable& table, std::size_t target_bytes, bool over_may_follow,
                             std::size_t frame_overhead)
    : out_(table),
      target_bytes_(target_bytes),
      // And the bit that ends a run of segments.
      reserved_bits_(over_may_follow ? BundleWriter(table).BitsWith(OverEntry{}) + 1 : 0),
      frame_overhead_(frame_overhead) {}

bool BundleBuilder::Add(const BundleEntry& entry) {
  const std::size_t bits = out_.BitsWith(entry) + reserved_bits_;
  const std::size_t alone_bits = IsMessage(entry) ? most_bits_ : control_bits_;
  if (bits > (has_message_ ? 8 * target_bytes_ : alone_bits)) return false;
  out_.Write(entry);
  has_message_ = has_message_ || IsMessage(entry);
  return true;
}

void BundleBuilder::Confine(std::size_t message_bits) {
  most_bits_ = 8 * target_bytes_;
  control_bits_ = most_bits_ - std::min(most_bits_, message_bits);
}

void BundleBuilder::LimitTo(std::size_t bytes) {
  if (out_.bits() + reserved_bits_ <= 8 * bytes) target_bytes_ = std::min(target_bytes_, bytes);
}

void BundleBuilder::AddOver() {
  out_.Write(OverEntry{});
}

std::size_t BundleBuilder::Bytes() const {
  return (out_.bits() + 7) / 8;
}

std::size_t BundleBuilder::FrameBytes() const {
  return Bytes() + frame_overhead_;
}

std::vector<std::byte> BundleBuilder::Finish() {
  return out_.Finish();
}

}  // namespace priamos::bus::radio
