#pragma once

#include "bus/process.hpp"

namespace priamos::console {

/// The station on a log that somebody plays onto its bus: shows it until a signal, and sends nothing. Throws
/// as the start of a console does.
int ShowPlayedLog(const bus::PlayedLog& log);

}  // namespace priamos::console
