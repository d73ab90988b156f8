#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "common/time.hpp"
#include "common/web/web_listener.hpp"
#include "common/web/web_options.hpp"

namespace priamos {

/// Serves the files of a page and its WebSockets, all in the calling thread: nothing happens but within Poll.
class WebServer {
 public:
  /// Throws std::runtime_error with one sentence when no port can be had. `files` and `listener` must outlive
  /// it.
  WebServer(const WebServerOptions& options, const WebFiles& files, WebListener& listener);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Does what is to be done without waiting, bounded whatever anybody sends.
  void Poll(Time now);
  /// Sends a message to a page; false, and nothing is sent, when it has not taken the one before.
  bool Send(std::uint64_t client, std::string message, bool binary = false);
  /// Sends a message after those that wait already; false, and nothing is sent, when too much waits.
  bool Queue(std::uint64_t client, std::string message, bool binary);
  /// A new picture of the camera, for everybody who looks.
  void ShowPicture(Time exposed, std::string jpeg);
  /// Whether somebody looks at the camera, or did within the last second.
  bool is_watched() const;
  /// "http://127.0.0.1:8080/".
  std::string address() const;
  int sockets() const;
  const WebCounters& counters() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace priamos
