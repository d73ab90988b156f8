#pragma once

#include "cli/verbs/help/doctor.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// What the newest LINK_STATUS of one end says of the radio between robot and workstation: bad while nothing
/// of the other end comes, or the two ends are no pair.
Finding LinkFinding(const link_status_t& status);

}  // namespace priamos::cli
