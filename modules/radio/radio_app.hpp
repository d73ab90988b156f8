#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "bus/other_bus.hpp"
#include "bus/radio/link_config.hpp"
#include "bus/radio/station.hpp"
#include "bus/schema/schema.hpp"
#include "common/serial_port.hpp"
#include "radio/bus_end.hpp"
#include "radio/file_store.hpp"
#include "radio/link_health.hpp"
#include "radio/net_port.hpp"
#include "radio/radio_config.hpp"

namespace priamos::radio {

/// One end of the radio link on one LCM bus; or the station of several robots that share a channel, with a
/// bus for each. Carries every channel of link.toml, also of types it was never compiled with. See README.md.
class RadioApp {
 public:
  static constexpr std::string_view kName = "radio";
  static constexpr std::string_view kSummary = "One end of the radio link between two LCM buses.";
  static constexpr std::array<bus::OptionAlias, 5> kOptions{
      {{"--port", "port", "", "serial port of the modem, or udp:HOST:PORT, tcp:HOST:PORT, tcp::PORT"},
       {"--address", "address", "", "of this robot, on a channel that several share"},
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
  bus::radio::LinkConfig LoadLink() const;
  void CheckRobots() const;
  void OpenLine();
  void AddEnd(const StationRobot& robot, std::uint8_t address, bus::Node& node);
  void AddRobots();
  void CheckFiles() const;
  void Start(Time now);
  void ReadLine();
  void Receive(std::span<const std::byte> bytes);
  void ReadFrames();
  void FeedLine(Time now);
  void Report(Time now);
  LinkHealth ReportMemory(Time now);
  void RaiseAlarm(const std::string& text, Time now);
  const bus::Schema& types() const { return own_types_ ? *own_types_ : context_.node().schema(); }
  bus::radio::LinkKey LoadKey(const std::string& file) const;
  std::optional<bus::radio::LinkKey> LoadNextKey(const std::string& file,
                                                 const bus::radio::LinkKey& key) const;
  std::unique_ptr<bus::radio::StateStore> OpenStore(const StationRobot& robot, std::uint8_t address);
  bus::radio::NonceSource Nonces() const;

  RadioConfig config_;
  bus::Context& context_;
  bus::radio::LinkConfig link_config_;
  std::optional<bus::Schema> own_types_;  ///< message types in the folder config.types
  bus::radio::Direction outgoing_;
  std::unique_ptr<ByteStream> port_;                   ///< of a serial line
  std::unique_ptr<NetPort> net_;                       ///< of a link over IP
  std::vector<std::unique_ptr<bus::OtherBus>> buses_;  ///< at a station: the robots' buses
  std::vector<bus::radio::LinkKey> keys_;              ///< of the ends
  std::vector<FileStore*> stores_;                     ///< of the ends that keep a memory in files
  std::string memory_problem_;                         ///< as of the last report
  std::optional<bus::Publisher<alarm_t>> alarms_;      ///< since the first alarm
  std::vector<std::unique_ptr<BusEnd>> ends_;          ///< one; at a station one for each robot
  std::optional<bus::radio::Station> station_;         ///< since the first tick
  std::vector<std::byte> unwritten_;                   ///< bytes that the port has not taken yet
  std::optional<Time> next_report_;                    ///< since the first tick
};

}  // namespace priamos::radio
