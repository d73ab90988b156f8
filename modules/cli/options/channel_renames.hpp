#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/log/log_selection.hpp"

namespace priamos::cli {

/// Renamings, `A=B` of every --rename: channel A becomes B. Throws std::runtime_error with a sentence for
/// text that is no such pair, for a B that no LCM channel can have, and for an A that is given twice.
std::map<std::string, std::string> ParseRenames(const std::vector<std::string>& pairs);

/// Checks the renamings of channels. Throws std::runtime_error when `selection` renames a channel that `log`,
/// which has the channels `there`, lacks, or when two channels would get one name: afterwards nobody could
/// tell them apart.
void RequireRenamesFit(const bus::LogSelection& selection, const std::set<std::string>& there,
                       const std::string& log);

}  // namespace priamos::cli
