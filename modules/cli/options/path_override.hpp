#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace priamos::cli {

/// `KEY="PATH"` with the absolute path, as ConfigSource takes a key that is set beside its file. The path may
/// have blanks and quotes.
std::string PathOverride(std::string_view key, const std::filesystem::path& path);

}  // namespace priamos::cli
