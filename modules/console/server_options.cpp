#include "console/server_options.hpp"

#include "common/web/token_file.hpp"
#include "console/core/browser_message.hpp"
#include "console/foxglove/client_message.hpp"

namespace priamos::console {

WebServerOptions ServerOptionsOf(const ConsoleConfig& config, const std::string& token_file) {
  WebServerOptions options;
  options.address = config.address;
  options.port = config.port;
  options.ports = config.ports;
  options.max_sockets = config.pages;
  options.max_connections = 4 * config.pages;
  options.max_message = kMaxBrowserMessage;
  options.max_client_message = kMaxClientMessage;
  options.access = LoadAccess(config.address, token_file);
  options.access.foxglove_origins = WordsOf(config.foxglove_origins);
  return options;
}

}  // namespace priamos::console
