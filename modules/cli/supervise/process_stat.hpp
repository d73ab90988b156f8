#pragma once

#include <sys/types.h>

#include "common/time.hpp"

namespace priamos::cli {

/// Whether a signal, not a debugger, has stopped the process, as the kernel reports it. False when it is
/// gone.
bool IsStopped(pid_t pid);

/// For how long the first thread of the process, which reports that it lives, has waited for a processor
/// since it was started, as the kernel counts it. Zero when it is gone, or the kernel does not count.
Duration WaitedForProcessor(pid_t pid);

}  // namespace priamos::cli
