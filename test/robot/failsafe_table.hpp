#pragma once

#include <fmt/format.h>

#include <string>

#include "robot/core/safety/failsafe.hpp"

namespace priamos::robot {

/// Whom a rule is about, as the table prints it.
inline std::string_view SourceText(DriveSource source) {
  switch (source) {
    case DriveSource::kPath:
      return "a path";
    case DriveSource::kOperator:
      return "an operator";
    case DriveSource::kNone:
      break;
  }
  return "anybody";
}

/// The rules as the table of modules/robot/README.md (Markdown).
inline std::string FailsafeTable(const FailsafeConfig& config) {
  std::string table =
      "| Condition | While driven by | After | Action | Gone for | Cleared by |\n"
      "|---|---|---|---|---|---|\n";
  for (const FailsafeRule& rule : FailsafeRules(config)) {
    table += fmt::format("| {} | {} | {} s | {} | {} s | {} |\n", rule.meaning, SourceText(rule.source),
                         rule.after_s, rule.action == FailsafeAction::kHalt ? "halt" : "hold", rule.clear_s,
                         rule.cleared_by);
  }
  return table;
}

}  // namespace priamos::robot
