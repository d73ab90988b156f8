#pragma once

#include <functional>
#include <string>

#include "common/web/web_options.hpp"
#include "console/console_config.hpp"

namespace priamos::console {

/// Where the station listens and whom it lets in, from the files that `config` names, each found by `path`.
/// Throws std::runtime_error as LoadAccess and LoadTls do.
WebServerOptions ServerOptionsOf(const ConsoleConfig& config,
                                 const std::function<std::string(const std::string&)>& path);

}  // namespace priamos::console
