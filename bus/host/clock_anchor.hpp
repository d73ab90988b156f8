#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/time.hpp"

namespace priamos::bus {

/// What the processes of one host add to its boot clock to get Unix time.
struct ClockAnchor {
  Duration unix_minus_boot{};
  std::filesystem::path file;  ///< where it is agreed on; empty: this process has its own
  std::string problem;         ///< why it has its own, one sentence; else empty
};

/// A folder that may hold the anchor.
struct AnchorFolder {
  std::filesystem::path path;
  bool trusted_place = false;  ///< only root can have made it there, whoever owns it
  bool readable_by_all = false;
};

/// Where this host keeps its anchor, the first that works: `$PRIAMOS_RUNTIME` alone when it is set; else
/// /run/priamos, which root and systemd make; else /tmp/priamos-UID, which outlives a logout.
std::vector<AnchorFolder> AnchorFolders();

/// Takes the anchor `name` that another process of this host and boot has written into one of `folders`, or
/// writes `proposal` there for all that come later. Files are read as hostile input: what is no regular file
/// of root, of this user or of the folder's owner, what others may write, or is no anchor, is not used, and
/// `problem` says so. Never throws.
ClockAnchor AgreeOnAnchor(const std::vector<AnchorFolder>& folders, const std::string& name,
                          Duration proposal);

/// Name of the file for this boot of this host; empty when the kernel does not say which boot it is.
std::string AnchorName();

}  // namespace priamos::bus
