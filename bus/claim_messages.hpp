#pragma once

#include <cstdint>
#include <string>

#include "bus/claim.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

claim_t ToMessage(const ClaimWord& word, Time now);
ClaimWord FromMessage(const claim_t& message);

/// This process as a claimant; the instance is drawn at random and is never 0.
Claimant MakeClaimant(const std::string& robot, const std::string& role);

/// Where it runs and since when, e.g. pid 12 on hall9, since 2026-11-22 06:31:12. `now` is of a clock
/// anchored to the date.
std::string Whereabouts(const ClaimWord& word, Time now);
/// Role and robot of the claimant, then its Whereabouts().
std::string Describe(const ClaimWord& word, Time now);

}  // namespace priamos::bus
