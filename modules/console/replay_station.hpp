#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "common/rate_limit.hpp"
#include "common/web/web_listener.hpp"
#include "common/web/web_server.hpp"
#include "console/audience.hpp"
#include "console/core/beats.hpp"
#include "console/foxglove_bridge.hpp"
#include "console/news_feed.hpp"
#include "console/shown_log.hpp"
#include "console/station_files.hpp"

namespace priamos::bus {
class Schema;
}

namespace priamos::console {

/// The station's page, and the bridge for Foxglove, on a log instead of a robot: who looks sees what an
/// operator saw, and steers the log where it can be steered. Ages are those of the log: they stand while it
/// does. Nothing is sent to any bus.
class ReplayStation : public WebListener, public LogListener {
 public:
  /// `log`: of the workstation's bus. `greeting` with the log's length. Throws std::runtime_error when no
  /// port can be had.
  ReplayStation(std::unique_ptr<ShownLog> log, const bus::Schema& schema, const GroundPlan& plan,
                std::string greeting, const WebServerOptions& options);

  /// Serves pages and plays what is due.
  void Tick(Time now);
  std::string address() const { return server_.address(); }

 private:
  void Joined(std::uint64_t client, const OpenSocket& socket) override;
  bool Said(std::uint64_t client, std::string_view message, bool binary) override;
  void Left(std::uint64_t client) override;
  void Heard(const std::string& channel, std::span<const std::byte> bytes, Time time) override;
  void Begun() override;
  nlohmann::ordered_json Station() const;

  std::unique_ptr<ShownLog> log_;
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
