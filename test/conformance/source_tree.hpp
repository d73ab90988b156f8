#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace priamos {

/// Content of a file; empty when there is none.
std::string TextOf(const std::filesystem::path& file);

/// Folders, relative to `root`, in the order in which the CMakeLists.txt files name them; a parent comes
/// after its rooms.
std::vector<std::string> FolderOrder(const std::filesystem::path& root);

/// A room in C for other projects, which copy it: it stands beside the rules of the house, and alone.
inline constexpr const char* kStandalone = "bus/radio/tiny";
/// The folder of a project that has the installed bus and nothing else.
inline constexpr const char* kExample = "bus/package/example";
/// Whether the rules of the tree do not hold in a folder.
bool IsStandalone(const std::filesystem::path& folder);

/// Sources of every language below `folders`, relative to `root`, sorted; none of standalone folders.
std::vector<std::filesystem::path> SourcesIn(const std::filesystem::path& root,
                                             std::initializer_list<const char*> folders);

/// Headers that a text includes in quotes.
std::vector<std::string> QuotedIncludes(const std::string& text);

/// Folder of the tree that an include means, from the root or from modules/; "lcmtypes" for what lcm-gen
/// makes. Empty for an include that is spelled in any other way.
std::string FolderOf(const std::filesystem::path& root, const std::string& header);

}  // namespace priamos
