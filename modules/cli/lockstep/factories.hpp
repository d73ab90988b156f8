#pragma once

#include <memory>
#include <string>

#include "bus/app.hpp"
#include "common/config_keys.hpp"

namespace priamos::cli {

/// The App of a module by its folder's name. The command line is where modules come together; nothing else
/// may know more than one. Throws std::invalid_argument for an unknown name.
bus::AppFactory FactoryFor(const std::string& module);

/// The keys of its configuration. Throws the same.
std::vector<ConfigKey> ConfigKeysOf(const std::string& module);

/// Modules some of whose parameters may be changed while they run.
std::vector<std::string> ModulesWithParameters();

/// What Apps made one after the other in this thread need not set up again while it is held: the graphics.
std::shared_ptr<void> HoldShared();

}  // namespace priamos::cli
