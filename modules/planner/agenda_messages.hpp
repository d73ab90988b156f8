#pragma once

#include <cstddef>

#include "lcmtypes/channels.hpp"
#include "planner/core/agenda/agenda.hpp"

namespace priamos::planner {

/// The order that a command gives: the steps of RUN, else its one mission.
AgendaOrder OrderIn(const mission_command_t& message);
/// So many of the newest ends are in a status, which has to fit a datagram.
inline constexpr std::size_t kShownResults = 3;
/// How the orders stand. `n_later`: so many of the newest ends are left for a later status.
mission_status_t StatusOf(const Agenda& agenda, Time now, std::size_t n_later = 0);

}  // namespace priamos::planner
