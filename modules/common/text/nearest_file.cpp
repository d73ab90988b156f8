#include "common/text/nearest_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "common/text/nearest_word.hpp"

namespace priamos {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 4;

/// Without links that lead nowhere.
std::vector<std::string> NamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code unreadable, unknown;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, unreadable))
    if (fs::exists(entry.path(), unknown)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> WithTheStemOf(const std::string& name, const std::vector<std::string>& names) {
  std::vector<std::string> same;
  for (const std::string& other : names)
    if (fs::path(other).stem() == fs::path(name).stem()) same.push_back(other);
  return same;
}

std::vector<std::string> NamesIn(const fs::path& folder, std::string_view ending) {
  auto names = NamesIn(folder);
  std::erase_if(names, [&](const std::string& name) { return !name.ends_with(ending); });
  return names;
}

/// Paths `folder/name` of each of `names`, and behind it as much of `rest` as leads to something.
std::string Text(const char* begin, const fs::path& folder, std::vector<std::string> names,
                 const fs::path& rest) {
  if (names.empty()) return "";
  names.resize(std::min(names.size(), kMostFiles));
  for (std::string& name : names) {
    const fs::path found = folder / name;
    name = !rest.empty() && fs::exists(found / rest) ? found / rest : found;
  }
  return fmt::format("{}\"{}\"", begin, fmt::join(names, "\" or \""));
}

}  // namespace

std::string NearestFileText(const std::string& path, std::string_view ending) {
  std::error_code unreadable;
  if (path.empty()) return "";
  if (fs::is_directory(path, unreadable)) return Text("; in that folder: ", path, NamesIn(path, ending), {});
  fs::path folder = fs::path(path).parent_path(), wrong = fs::path(path).filename(), rest;
  while (!folder.empty() && folder.has_relative_path() && !fs::is_directory(folder, unreadable)) {
    rest = rest.empty() ? wrong : wrong / rest;
    wrong = folder.filename();
    folder = folder.parent_path();
  }
  const auto names = NamesIn(folder);
  auto near = NearestWords(wrong.string(), names);
  if (near.empty()) near = WithTheStemOf(wrong, names);
  return Text("; nearest: ", folder, near, rest);
}

}  // namespace priamos
