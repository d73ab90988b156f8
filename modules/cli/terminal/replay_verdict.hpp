#pragma once

#include <cstdint>
#include <string>

#include "bus/output_comparison.hpp"

namespace priamos::cli {

/// How the outputs of a module that was run again from a log compare with those of the log.
struct ReplayVerdict {
  std::string log, module;
  std::uint64_t fed = 0;            ///< messages that the module was given
  std::uint64_t skipped_bytes = 0;  ///< of the log, which are no events
  bus::OutputComparison comparison;
};

/// The verdict as JSON in one line, without its end.
std::string JsonLine(const ReplayVerdict& verdict);

}  // namespace priamos::cli
