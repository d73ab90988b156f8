#pragma once

namespace priamos::bus {

/// Attaches a BPF filter to a UDP socket that passes only datagrams beginning with `LC02` (unfragmented LCM
/// messages); the kernel drops the others before anybody sees a byte.
///
/// Two crafted fragments with an offset near 2^32 kill any subscriber of LCM 1.3.1 inside its receive
/// thread. Parametric messages never fragment, so nothing is lost. Throws std::runtime_error when the kernel
/// refuses the filter.
void FilterSocket(int fd);

}  // namespace priamos::bus
