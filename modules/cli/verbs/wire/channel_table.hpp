#pragma once

#include <string>

namespace priamos::cli {

/// Every channel of lcmtypes/channels.hpp as a table in Markdown: name, type, nominal rate, life span,
/// largest size on LCM and packed for the radio. lcmtypes/README.md holds it; a test compares.
std::string ChannelTable();

/// Every channel of lcmtypes/channels.hpp as a JSON array, with the columns of ChannelTable.
std::string ChannelsAsJson();

}  // namespace priamos::cli
