#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/rate_limit.hpp"
#include "common/web/web_listener.hpp"
#include "common/web/web_server.hpp"
#include "console/audience.hpp"
#include "console/core/beats.hpp"
#include "console/foxglove_bridge.hpp"
#include "console/news_feed.hpp"
#include "console/station_files.hpp"

namespace priamos::bus {
class Schema;
}

namespace priamos::console {

/// Any LCM bus in a browser: everything that is heard, as the station's page plots it, and for Foxglove and
/// Lichtblick. It sends nothing to the bus.
class BusStation : public WebListener {
 public:
  /// Throws std::runtime_error when no port can be had. `schema` must outlive it.
  BusStation(const bus::Schema& schema, const WebServerOptions& options);

  void Hear(const std::string& channel, std::span<const std::byte> bytes, Time arrival);
  /// Serves everybody who is connected.
  void Tick(Time now);
  std::string address() const { return server_.address(); }

 private:
  void Joined(std::uint64_t client, const OpenSocket& socket) override;
  bool Said(std::uint64_t client, std::string_view message, bool binary) override;
  void Left(std::uint64_t client) override;

  StationFiles files_;
  NewsFeed feed_;
  Audience audience_;
  FoxgloveBridge bridge_;
  Beats beats_;
  RateLimit beat_{20};
  std::string greeting_;
  WebServer server_;
};

}  // namespace priamos::console
