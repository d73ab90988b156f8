#pragma once

#include <string>

#include "common/web/web_options.hpp"
#include "console/console_config.hpp"

namespace priamos::console {

/// Where the station listens and whom it lets in. `token_file`: path; "" when everybody may who reaches it.
/// Throws ConfigError as LoadAccess does.
WebServerOptions ServerOptionsOf(const ConsoleConfig& config, const std::string& token_file);

}  // namespace priamos::console
