#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bus/radio/link.hpp"

/// Checks what the README of bus/radio promises, on everything that two ends were offered, sent and
/// delivered.
namespace priamos::bus::radio {

/// Key, channel table and direction of the explored ends are those of link_pair.hpp.
class Promises {
 public:
  Promises();

  /// The message to offer next on a channel: it says which it is. `size`: its length in bytes, at least 5.
  std::vector<std::byte> NextMessage(std::size_t channel, std::size_t size, Time now);
  /// Notes that the message made last on the channel was not accepted.
  void OnRefused(std::size_t channel);
  /// Notes that an end has lost memory: what was offered until now need not arrive, and may arrive twice.
  void OnMemoryLost();
  void OnDelivery(const Delivery& delivery, Direction incoming, Time now);
  /// Notes that an end has accepted a data frame.
  void OnAccepted(std::span<const std::byte> frame, Direction direction);
  /// Notes a frame without its delimiter, or a part of one, that was sent in an epoch under a key.
  void OnFrame(std::span<const std::byte> encoded, Direction direction, std::uint64_t epoch,
               const LinkKey& key);
  /// Notes how far an end was with the change of the key in the end.
  void OnKeyChange(KeyChange change, Direction outgoing);
  /// What the ends still owe, for the end of a run: every event, and of what was offered since they recovered
  /// seven of ten commands, and urgent events at once.
  void Settle(Time recovered);

  const std::vector<std::string>& broken() const { return broken_; }

 private:
  struct Channel {
    std::vector<Time> offered;        ///< by number
    std::vector<std::size_t> came{};  ///< numbers, in order
    std::vector<Duration> took{};     ///< from offer to delivery, of each that came
    std::set<std::size_t> refused{};
    std::size_t counted_from = 0;  ///< numbers below: offered before a memory was lost
  };
  void Break(std::string sentence);
  void CheckCommand(const Channel& channel, std::size_t number, const Delivery& delivery, Time now);
  void SettleEvents(std::size_t index, const Channel& channel);
  void SettleCommands(std::size_t index, const Channel& channel, Time recovered);
  void SettleUrgent(std::size_t index, const Channel& channel, Time recovered);

  ChannelTable table_;
  std::vector<Channel> channels_;
  std::map<std::pair<Direction, std::uint64_t>, FrameOpener> openers_;  ///< by direction and epoch
  std::set<std::pair<Direction, std::vector<std::byte>>> accepted_;
  std::vector<std::string> broken_;
};

}  // namespace priamos::bus::radio
