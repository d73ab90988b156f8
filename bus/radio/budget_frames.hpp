#pragma once

#include <cstddef>
#include <vector>

#include "bus/radio/channel_load.hpp"
#include "bus/radio/channels/age_bound.hpp"
#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/line/polling.hpp"
#include "bus/radio/link_options.hpp"

/// Frames of one direction: their bytes, and how long they take on the line.
namespace priamos::bus::radio {

/// Bytes are handed to the line once per tick.
constexpr double kTick_s = 0.001;

/// What the frames of one direction are for its messages: room, bytes, and times on the line.
class DirectionFrames {
 public:
  /// Frames of the channels of one direction; `table` must outlive it.
  DirectionFrames(const ChannelTable& table, const LinkOptions& options, Direction direction);

  /// Counts from now on with the polls of a shared channel: one frame of this direction per turn of a robot.
  void SetPolled(const PollBounds& bounds, int robots);
  const std::vector<ChannelLoad>& loads() const { return loads_; }
  /// Guaranteed share of the line for this direction, 0..1.
  double share() const { return duty_.rate() * turn_s_ / (turn_s_ + gap_s_); }
  /// Load of the acknowledgements.
  double ControlBytesPerSecond() const;
  /// Load of a channel at its rate.
  double BytesPerSecond(const ChannelLoad& load) const;
  /// Time from the offer of a message that is the next to go, to its last byte at the receiver: it waits for
  /// the longest frame (half-duplex: and turn), and no emergency stop comes in between.
  double NextSeconds(const ChannelLoad& load) const;
  /// Longest time from the end of a frame to the end of the next one.
  double SilenceSeconds() const;
  /// The same of any end, as the other one hears it; of a robot on a shared channel also while nobody drives
  /// it.
  double LongestSilenceSeconds() const;
  /// Time on air that urgent frames take at most beyond what is paid for: with bursts of all of them, and an
  /// ordinary frame before.
  double CreditSeconds() const;
  /// Bytes of the longest frame, with the whole counter, as a packet must hold it.
  std::size_t LongestFrameBytes() const { return longest_bytes_; }
  /// The same as a time on the line, with the delimiter that leads after silence.
  Duration LongestFrameTime() const;
  /// Time on the line of the longest frame with an urgent event; 0 without such a channel.
  double UrgentFrameSeconds() const;
  /// Bytes of the smallest bundle that always has room for a message beside acknowledgements.
  std::size_t SmallestBundleBytes() const;
  /// Least `fresh_s` that can be kept in this direction: two frames as full as can be, or the longest message
  /// that goes alone between two short ones, and a hello.
  double LeastFreshSeconds() const;
  /// Time by which a byte may be handed over before it leaves; of a packet, before all of it has left.
  double AheadSeconds() const;
  /// Longest time from the arrival of an urgent event to the end of the frame with its acknowledgement: the
  /// next one.
  double AnswerSeconds() const;

 protected:
  double FrameSeconds(double bits) const;
  double AckFrameSeconds() const;
  double AllFramesSeconds(const ChannelLoad& load) const;
  double InTurns(double work_s) const;
  double ControlEntriesIn(double window_s) const;
  double ControlBitsIn(double window_s) const;

  /// Whether frames have the state whose age is bounded beside this message, however often that comes.
  bool BesideFresh(const ChannelLoad& load) const;
  /// Time on the line of a frame that is short for its sake, at most: beside it go a message that is longer
  /// than a bundle, and the next frame with it.
  double LongestShortFrameSeconds() const;
  /// Bits of that state.
  double FreshBits() const { return 8.0 * static_cast<double>(age_bound_.entry_bytes()); }
  /// Whether a message of the channel is longer than a bundle, and goes alone.
  bool GoesAlone(const ChannelLoad& load) const { return load.newest_only && load.bits > bundle_bits_; }

  Direction direction_;
  AgeBound age_bound_;
  double byte_s_;
  DutyCycle duty_;
  bool packets_;             ///< an urgent frame waits for the end of the one on the air
  std::size_t frame_bytes_;  ///< bytes of a frame besides its bundle
  double ahead_s_;
  double control_bits_ = 0;
  double bundle_bits_ = 0;    ///< of a bundle of several messages
  double capacity_bits_ = 0;  ///< the same without acknowledgements
  double frame_s_ = 0;
  int robots_ = 0;  ///< on a shared channel; 0: a link of two ends
  PollBounds polled_{};
  double gap_s_ = 0;                   ///< between two turns; without turns 0
  double repeat_s_ = 0;                ///< time until an urgent event of this direction is acknowledged
  std::vector<ChannelLoad> answered_;  ///< urgent events of the other direction
  std::vector<ChannelLoad> loads_;

 private:
  double OverBits() const;
  double RepeatedFrameSeconds(double bits) const;
  double ControlBits() const;
  void ConfineTo(double bundle_bytes, double& largest_bytes);
  void ShareTheAir(const LinkOptions& options);

  const ChannelTable& table_;
  bool datagrams_;
  double keep_alive_s_;
  std::size_t longest_bytes_ = 0;
  double largest_bits_ = 0;  ///< of an entry of a message
  double turn_s_ = 1;        ///< length of a turn; without turns 1, with gap_s_ = 0
  double overhead_ = 1;
};

}  // namespace priamos::bus::radio
