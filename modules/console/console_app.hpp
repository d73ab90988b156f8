#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "bus/radio/link_config.hpp"
#include "common/pilot/pilot.hpp"
#include "common/pilot/stop_keeper.hpp"
#include "common/rate_limit.hpp"
#include "common/web/web_server.hpp"
#include "console/audience.hpp"
#include "console/audit_log.hpp"
#include "console/console_config.hpp"
#include "console/console_messages.hpp"
#include "console/core/beats.hpp"
#include "console/core/seat.hpp"
#include "console/core/wanted_channels.hpp"
#include "console/foxglove_bridge.hpp"
#include "console/news_feed.hpp"
#include "console/page_orders.hpp"
#include "console/station_files.hpp"
#include "console/video_feed.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {

/// The station: serves a page that shows what comes over the radio, and drives from it. See README.md.
class ConsoleApp : public WebListener {
 public:
  static constexpr std::string_view kName = "console";
  static constexpr std::string_view kDefaultBus = "offboard";
  static constexpr std::string_view kSummary =
      "The station: a page for a browser that shows what comes over the radio, and drives.";
  static constexpr std::array<bus::OptionAlias, 1> kOptions{
      {{"--port", "port", "", "first TCP port that is tried"}}};
  static constexpr bool kFollowsLogs = true;  // main.cpp: ShowPlayedLog
  using Config = ConsoleConfig;

  ConsoleApp(const ConsoleConfig& config, bus::Context& context);

  Duration TickPeriod() const { return FromSeconds(1 / config_.rate_hz); }
  void Tick(Time now);

 private:
  void Joined(std::uint64_t client, const OpenSocket& socket) override;
  bool Said(std::uint64_t client, std::string_view message, bool binary) override;
  void Left(std::uint64_t client) override;
  std::optional<Refusal> Obey(ClientId client, std::string_view page_message);
  Role RoleOf(ClientId client) const;
  bool Take(std::uint64_t client, const StickReport& report);
  bool Take(std::uint64_t client, const StopOrder& order);
  bool Take(std::uint64_t client, const ListenWish& wish);
  bool Take(std::uint64_t client, const ProcessWish& wish);
  bool Take(std::uint64_t, const MissionOrder& order) { return orders_.Take(order, now_); }
  bool Take(std::uint64_t, const PlaceOrder& order) { return orders_.Take(order, now_); }
  bool Take(std::uint64_t, const AimOrder& order) { return orders_.Take(order, now_); }
  bool Take(std::uint64_t client, const AlarmSeen& seen) { return orders_.Take(seen, names_[client], now_); }
  bool Take(std::uint64_t, const ParameterWish& wish) { return orders_.Take(wish); }
  bool Take(std::uint64_t, const ReplayOrder&) { return false; }  // there is no log

  void Show(std::string_view channel);
  void ServeFoxglove();
  void OpenVideo();
  void Drive(Time now);
  void NoteDriver(Time now);
  void TakeSheets();
  void Send(const PilotOutput& output, Time now);
  nlohmann::ordered_json Station(std::uint64_t client, Role role) const;
  void Count(Time now);
  void NoteAudit();

  ConsoleConfig config_;
  bus::Context& context_;
  bus::radio::LinkConfig link_;
  GroundPlan plan_;
  std::string greeting_;  ///< first text for every page
  StationFiles files_;
  ParameterQuestion parameters_;
  AuditLog audit_;
  std::optional<ClientId> drove_;  ///< whose hand was on the stick at the last tick
  NewsFeed feed_;
  Audience audience_;
  std::map<ClientId, std::string> names_;  ///< of who is connected: his token's, else his address
  FoxgloveBridge bridge_;
  Beats beats_;
  Seat seat_;
  Pilot pilot_;
  StopKeeper stop_;
  WantedChannels wanted_;
  Sender base_, head_;
  RobotView robot_;
  RateLimit beat_, count_{1};
  Time now_{};
  std::uint64_t late_ = 0;  ///< wishes of pages that came too late
  std::uint64_t counted_ = 0;
  std::uint64_t unwritten_ = 0;  ///< acts that the audit log lacks
  PageOrders orders_;

  bus::Latest<drive_status_t> status_;
  bus::Publisher<drive_command_t> drive_;
  bus::Publisher<head_drive_t> head_drive_;
  bus::Publisher<lease_request_t> lease_;
  bus::Publisher<estop_t> estop_;
  bus::Publisher<link_request_t> request_;
  std::unique_ptr<WebServer> server_;  ///< none in lockstep
  std::optional<VideoFeed> video_;     ///< none without a video link, and in lockstep
};

}  // namespace priamos::console
