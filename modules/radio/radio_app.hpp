#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "bus/radio/link.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/radio/message_codecs.hpp"
#include "bus/schema/schema.hpp"
#include "common/serial_port.hpp"
#include "lcmtypes/channels.hpp"
#include "radio/echo_filter.hpp"
#include "radio/net_frame.hpp"
#include "radio/pause_watch.hpp"
#include "radio/radio_config.hpp"
#include "radio/radio_messages.hpp"

namespace priamos::radio {

/// One end of the radio link on one LCM bus. Carries every channel of link.toml, also of types it was never
/// compiled with. See README.md.
class RadioApp {
 public:
  static constexpr std::string_view kName = "radio";
  static constexpr std::string_view kSummary = "One end of the radio link between two LCM buses.";
  static constexpr std::array<bus::OptionAlias, 4> kOptions{
      {{"--port", "port", "", "serial port of the modem, or udp:HOST:PORT, tcp:HOST:PORT, tcp::PORT"},
       {"--types", "types", "", "folder of .lcm files: carry your own types"},
       {"--onboard", "side", "\"onboard\"", "this is the robot's end"},
       {"--offboard", "side", "\"offboard\"", "this is the workstation's end"}}};
  static constexpr bool kOneOwner = true;
  using Config = RadioConfig;

  /// Loads the link and its key and opens the port. Throws ConfigError or std::runtime_error with one
  /// sentence.
  RadioApp(const RadioConfig& config, bus::Context& context);
  ~RadioApp();

  Duration TickPeriod() const { return FromSeconds(config_.tick_s); }
  void Tick(Time now);

 private:
  struct Waiting {
    std::size_t channel;
    std::vector<std::byte> encoded;
  };
  bus::radio::LinkConfig LoadLink() const;
  void OpenLine();
  void SubscribeAll();
  void StartLink(Time now);
  void LogRefusal(std::size_t channel, std::span<const std::byte> encoded, Time at);
  void ServeListeners(Time now);
  void ReadLine();
  void ReadFrames();
  void FeedLine(Time now);
  void Publish(const bus::radio::Delivery& delivery, Time now);
  void Report(Time now);
  const bus::Schema& types() const { return own_types_ ? *own_types_ : context_.node().schema(); }
  bus::radio::LinkKey LoadKey() const;
  std::optional<bus::radio::LinkKey> LoadNextKey() const;
  void LogKeyChange(bus::radio::KeyChange change);
  bus::radio::NonceSource Nonces() const;

  RadioConfig config_;
  bus::Context& context_;
  bus::radio::LinkConfig link_config_;
  std::optional<bus::Schema> own_types_;  ///< message types in the folder config.types
  bus::radio::Direction outgoing_;
  bus::radio::MessageCodecs codecs_;
  bus::radio::LinkKey key_;
  std::optional<bus::radio::LinkKey> next_key_;  ///< that the link is to change to
  std::unique_ptr<ByteStream> port_;             ///< of a serial line
  std::unique_ptr<NetPort> net_;                 ///< of a link over IP
  std::unique_ptr<bus::radio::StateStore> store_;
  std::unique_ptr<bus::radio::LinkEndpoint> link_;  ///< since the first tick, which brings the time
  EchoFilter echo_;
  std::optional<PauseWatch> pauses_;  ///< since the first tick
  bus::Inbox<link_request_t> requests_;
  std::map<std::size_t, Time> listening_until_;  ///< on-request channels of the other end
  std::vector<Waiting> waiting_;                 ///< messages that came before the first tick
  std::vector<std::byte> unwritten_;             ///< bytes that the port has not taken yet
  bus::Publisher<link_status_t> status_;
  std::optional<Time> next_report_;
  Time last_report_{};
  ReportState reported_;
  std::uint64_t undecodable_ = 0;
  std::set<std::string> refusals_;  ///< reasons for which a message was not sent, already in the log
  bool was_up_ = false;
  bus::radio::KeyChange logged_change_ = bus::radio::KeyChange::kNone;
};

}  // namespace priamos::radio
