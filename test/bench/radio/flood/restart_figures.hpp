#pragma once

#include <string>

#include "test/bench/radio/figures.hpp"

namespace priamos::bench {

/// How long commands stay away over UDP when one end is started again: `restarts` times without a flood, then
/// as often with 10 000 datagrams per second that replay what the other end sent to one of the two ever
/// since. `programs`: folder of priamos-radio.
void Restarts(Figures& figures, const std::string& programs, int restarts);

}  // namespace priamos::bench
