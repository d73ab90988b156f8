#include "console/server_options.hpp"

#include "common/web/tls_files.hpp"
#include "common/web/token_file.hpp"
#include "console/core/browser_message.hpp"
#include "console/foxglove/client_message.hpp"

namespace priamos::console {

WebServerOptions ServerOptionsOf(const ConsoleConfig& config,
                                 const std::function<std::string(const std::string&)>& path) {
  WebServerOptions options;
  options.address = config.address;
  options.port = config.port;
  options.ports = config.ports;
  options.max_sockets = config.pages;
  options.max_connections = 4 * config.pages;
  options.max_message = kMaxBrowserMessage;
  options.max_client_message = kMaxClientMessage;
  options.access = LoadAccess(config.address, config.token_file.empty() ? "" : path(config.token_file));
  options.access.foxglove_origins = WordsOf(config.foxglove_origins);
  if (!config.certificate_file.empty())
    options.tls = LoadTls(path(config.certificate_file), path(config.key_file));
  return options;
}

}  // namespace priamos::console
