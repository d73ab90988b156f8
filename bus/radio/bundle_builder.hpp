#pragma once

#include <cstddef>
#include <vector>

#include "bus/radio/channels/bundle.hpp"

namespace priamos::bus::radio {

/// The bundle size in bytes with the highest throughput over a line that loses the share `loss` (0..1) of its
/// frames; at most `max_bytes`. `frame_overhead`: bytes of a frame beside its bundle.
std::size_t BestBundleBytes(std::size_t max_bytes, double loss, std::size_t frame_overhead = kFrameOverhead);

/// Builds a bundle: takes entries as long as they fit.
class BundleBuilder {
 public:
  /// Empty bundle; `table` must outlive the builder. `over_may_follow`: leaves room for AddOver().
  /// `frame_overhead`: bytes of a short frame beside its bundle.
  BundleBuilder(const ChannelTable& table, std::size_t target_bytes, bool over_may_follow,
                std::size_t frame_overhead = kFrameOverhead);

  /// Adds an entry. Returns false, and adds nothing, if it does not fit. The first message may exceed the
  /// target up to the longest bundle, or a long one would never be sent.
  bool Add(const BundleEntry& entry);
  /// Makes the target hold for every message, and leaves room in it for one entry of `message_bits`: on a
  /// shared channel a longer frame would exceed the turn.
  void Confine(std::size_t message_bits);
  /// From now on messages are added only as long as the bundle has at most so many bytes; nothing changes
  /// when it has more already.
  void LimitTo(std::size_t bytes);
  /// Adds the entry that ends this end's turn on a half-duplex radio. It always fits.
  void AddOver();

  bool empty() const { return out_.bits() == 0; }
  /// Bytes of a bundle of several messages, at most.
  std::size_t target_bytes() const { return target_bytes_; }
  /// Bytes of the bundle as it is now.
  std::size_t Bytes() const;
  /// Bytes of the frame that this bundle would make now, with the short form of the counter.
  std::size_t FrameBytes() const;
  /// The bundle; the builder is used up.
  std::vector<std::byte> Finish();

 private:
  BundleWriter out_;
  std::size_t target_bytes_;
  std::size_t reserved_bits_;
  std::size_t frame_overhead_;
  std::size_t most_bits_ = 8 * kMaxBundleBytes;     ///< of a bundle with one message
  std::size_t control_bits_ = 8 * kMaxBundleBytes;  ///< of a bundle without
  bool has_message_ = false;
};

}  // namespace priamos::bus::radio
