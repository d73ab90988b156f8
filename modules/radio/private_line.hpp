#pragma once

#include <string>

namespace priamos::radio {

/// Whether nobody outside this machine can send on a line, as RadioConfig::port names it: a pseudo-terminal,
/// an address that only this machine has, or waiting (`tcp::PORT`), which NetAddress::loopback_only confines.
/// Looks up host names; one that has an address elsewhere, or none, is not private.
bool IsPrivateLine(const std::string& port);

}  // namespace priamos::radio
