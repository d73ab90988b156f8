#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/context.hpp"
#include "bus/radio/link.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/radio/message_codecs.hpp"
#include "bus/schema/schema.hpp"
#include "lcmtypes/channels.hpp"
#include "radio/echo_filter.hpp"
#include "radio/pause_watch.hpp"
#include "radio/radio_messages.hpp"

namespace priamos::radio {

/// What makes one end of a link: its channels, its secret and its memory.
struct BusEndParts {
  const bus::radio::LinkConfig& link;  ///< must outlive the end
  const bus::Schema& types;            ///< must outlive the end
  bus::radio::Direction outgoing;
  std::uint8_t address = 0;  ///< of the robot on a shared channel
  std::string name;          ///< of the robot, where there are several: goes before each line of the log
  bus::radio::LinkKey key;
  std::optional<bus::radio::LinkKey> next_key{};  ///< that the link is to change to
  std::string key_file{};                         ///< for the log; empty with the simulation key
  std::unique_ptr<bus::radio::StateStore> store;
  bus::radio::NonceSource nonces;
  Duration tick{};
};

/// One end of a link on one LCM bus: the bus's messages go to the link, and those of the link to the bus. It
/// knows nothing of the line.
class BusEnd {
 public:
  using LogFunction = std::function<void(bus::Level, std::string_view)>;
  /// Subscribes and advertises the link's channels on `node`, which must outlive the end.
  BusEnd(BusEndParts parts, bus::Node& node, LogFunction log);

  /// Makes the link, at the first tick, which brings the time; offers what came before.
  void Start(Time now);
  bool started() const { return link_ != nullptr; }
  bus::radio::LinkEndpoint& link() { return *link_; }

  /// Follows who listens to what, and how long this process sleeps.
  void Tick(Time now);
  /// Puts a message of the link on the bus.
  void Publish(const bus::radio::Delivery& delivery, Time now);
  /// Publishes LINK_STATUS of the time since the last report, and logs what changed.
  link_status_t Report(std::uint64_t turned_away, Time now);
  /// Saves the exact counters; the end is used up.
  void Close();

 private:
  struct Waiting {
    std::size_t channel;
    std::vector<std::byte> encoded;
  };
  void SubscribeAll();
  void Offer(std::size_t channel, std::span<const std::byte> encoded, Time came);
  void LogLate(std::size_t channel);
  void LogRefusal(std::size_t channel, std::span<const std::byte> encoded, Time at);
  void ServeListeners(Time now);
  void LogKeyChange(bus::radio::KeyChange change);
  void Log(bus::Level level, const std::string& text) const;

  BusEndParts parts_;
  bus::Node& node_;
  LogFunction log_;
  bus::radio::MessageCodecs codecs_;
  std::unique_ptr<bus::radio::LinkEndpoint> link_;  ///< since Start()
  EchoFilter echo_;
  std::optional<PauseWatch> pauses_;  ///< since Start()
  bus::Inbox<link_request_t> requests_;
  std::map<std::size_t, Time> listening_until_;  ///< on-request channels of the other end
  std::vector<Waiting> waiting_;                 ///< messages that came before Start()
  bus::Publisher<link_status_t> status_;
  Time last_report_{};
  ReportState reported_;
  std::uint64_t undecodable_ = 0;
  std::set<std::string> refusals_;  ///< reasons for which a message was not sent, already in the log
  bool was_up_ = false;
  bus::radio::KeyChange logged_change_ = bus::radio::KeyChange::kNone;
};

}  // namespace priamos::radio
