#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "test/support/shell.hpp"

namespace priamos {

/// Whether git knows what belongs to the tree: not in an exported archive.
inline bool IsGitClone(const std::filesystem::path& root) {
  return std::filesystem::exists(root / ".git");
}

/// Every file of the tree, where there is no git to ask; what is built, run or hidden is none.
inline std::vector<std::filesystem::path> FilesWithoutGit(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::end(it); ++it) {
    const std::string name = it->path().filename();
    const bool built = it.depth() == 0 && name.starts_with("build");
    if (it->is_directory() && (built || name.starts_with("."))) it.disable_recursion_pending();
    if (it->is_regular_file() && !name.starts_with(".")) files.push_back(fs::relative(it->path(), root));
  }
  return files;
}

/// The project's own files below `folder` of the tree `root`, as paths relative to `root`, sorted: what git
/// tracks, so that a test judges no file that its user put there. Throws std::runtime_error when git does not
/// answer.
inline std::vector<std::filesystem::path> ProjectFiles(
    const std::string& folder = "", const std::filesystem::path& root = PRIAMOS_SOURCE_DIR) {
  std::vector<std::filesystem::path> all;
  if (IsGitClone(root)) {
    // Whoever runs the tests may not own the clone.
    const ShellAnswer answer =
        RunShell("git -c safe.directory='*' -C '" + root.string() + "' ls-files -z | tr '\\0' '\\n'");
    if (answer.text.empty()) throw std::runtime_error("git ls-files: nothing in " + root.string());
    for (std::size_t begin = 0, end; (end = answer.text.find('\n', begin)) != std::string::npos;
         begin = end + 1)
      all.emplace_back(answer.text.substr(begin, end - begin));
  } else {
    all = FilesWithoutGit(root);
  }
  const std::string within = folder.empty() || folder.ends_with('/') ? folder : folder + "/";
  std::erase_if(all, [&](const std::filesystem::path& file) {
    return !file.string().starts_with(within) || !std::filesystem::exists(root / file);
  });
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace priamos
