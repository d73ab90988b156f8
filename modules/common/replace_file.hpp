#pragma once

#include <string>
#include <string_view>

namespace priamos {

/// Replaces a file as a whole, by a new one beside it: a process that dies at any moment leaves the old or
/// the new content. `durable`: so does a loss of power, for which it waits. `mode` as of open(2). Returns
/// false with errno set when it failed.
bool ReplaceFile(const std::string& path, std::string_view content, bool durable, unsigned mode);

/// Waits until what a file holds, and its name, survive a loss of power. Returns false with errno set when
/// that failed.
bool SyncFile(const std::string& path);

}  // namespace priamos
