#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "common/web/web_request.hpp"

namespace boost::asio::ssl {
class context;
}

namespace priamos {

/// Where a server listens and what it allows.
struct WebServerOptions {
  std::string address = "127.0.0.1";
  int port = 0;   ///< first one that is tried; 0: any
  int ports = 1;  ///< how many are tried; of port 0 one
  int max_connections = 64, max_sockets = 16;
  std::size_t max_message = 512;           ///< longest message of a page [byte]
  std::size_t max_client_message = 65536;  ///< longest one of a Foxglove client [byte]
  std::size_t max_waiting = 1 << 20;       ///< what may wait to be sent to one client [byte]
  double messages_per_s = 100;             ///< of one page, for long
  double head_timeout_s = 5;               ///< a request must have come whole within that
  double write_timeout_s = 5;              ///< a page that takes nothing for so long is gone
  WebAccess access{};
  std::shared_ptr<boost::asio::ssl::context> tls{};  ///< of LoadTls; none: no connection is encrypted
  std::string camera{};  ///< its pictures are served as /NAME.jpg and /NAME.mjpeg; empty: there is none
};

}  // namespace priamos
