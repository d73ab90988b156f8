#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "bus/log/log_player.hpp"
#include "common/rate_limit.hpp"
#include "console/audience.hpp"
#include "console/core/beats.hpp"
#include "console/core/browser_message.hpp"
#include "console/foxglove_bridge.hpp"
#include "console/news_feed.hpp"
#include "console/station_files.hpp"
#include "console/web/web_listener.hpp"
#include "console/web/web_server.hpp"

namespace priamos::bus {
class Schema;
}

namespace priamos::console {

/// The station's page, and the bridge for Foxglove, on a log instead of a bus: everybody who looks may pause,
/// step, seek and change the speed, and sees what an operator saw. Ages are those of the log: they stand
/// while it does. Nothing is sent to any bus.
class ReplayStation : public WebListener {
 public:
  /// `log`: of the workstation's bus. `greeting` with the log's length. Throws std::runtime_error when no
  /// port can be had.
  ReplayStation(bus::LogPlayer log, const bus::Schema& schema, const GroundPlan& plan, std::string greeting,
                const WebServerOptions& options);

  /// Serves pages and plays what is due.
  void Tick(Time now);
  std::string address() const { return server_.address(); }
  const bus::LogPlayer& log() const { return log_; }

 private:
  void Joined(std::uint64_t client, const OpenSocket& socket) override;
  bool Said(std::uint64_t client, std::string_view message, bool binary) override;
  void Left(std::uint64_t client) override;
  void Obey(const ReplayOrder& order);
  void Seek(Duration position);
  /// Plays what is due, so many events at most.
  void Play(int at_most);
  /// The log's own time.
  Time LogTime() const;
  nlohmann::ordered_json Station() const;

  bus::LogPlayer log_;
  std::string greeting_;
  const bus::Schema& schema_;
  StationFiles files_;
  NewsFeed feed_;
  Audience audience_;
  FoxgloveBridge bridge_;
  Beats beats_;
  RateLimit beat_{20};
  Time now_{};
  WebServer server_;
};

}  // namespace priamos::console
