#include "source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace priamos {
namespace {

namespace fs = std::filesystem;

void AddInOrder(const fs::path& root, const fs::path& folder, std::vector<std::string>& order) {
  static const std::regex kNamed(R"(^\s*add_subdirectory\(([\w/]+)\))");
  std::ifstream file(root / folder / "CMakeLists.txt");
  for (std::string line; std::getline(file, line);) {
    std::smatch m;
    if (std::regex_search(line, m, kNamed)) AddInOrder(root, folder / m[1].str(), order);
  }
  order.push_back(folder.string());
}

}  // namespace

bool IsStandalone(const fs::path& folder) {
  return folder == kStandalone || folder == kExample;
}

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> FolderOrder(const fs::path& root) {
  std::vector<std::string> order;
  AddInOrder(root, "", order);
  return order;
}

std::vector<fs::path> SourcesIn(const fs::path& root, std::initializer_list<const char*> folders) {
  static const std::set<std::string> kExtensions{".hpp", ".cpp", ".h", ".hh", ".c", ".cc", ".cxx", ".java"};
  std::vector<fs::path> sources;
  for (const char* folder : folders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path source = fs::relative(entry.path(), root);
      if (kExtensions.contains(source.extension()) && !IsStandalone(source.parent_path()))
        sources.push_back(source);
    }
  }
  std::sort(sources.begin(), sources.end());
  return sources;
}

std::vector<std::string> QuotedIncludes(const std::string& text) {
  static const std::regex kInclude(R"re(#\s*include\s*"([^"]+)")re");
  std::vector<std::string> headers;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), kInclude); it != std::sregex_iterator(); ++it)
    headers.push_back((*it)[1]);
  return headers;
}

std::string FolderOf(const fs::path& root, const std::string& header) {
  if (fs::path(header).lexically_normal() != header || header.starts_with("..")) return "";
  if (header.starts_with("priamos/")) return "lcmtypes";
  for (const char* from : {"", "modules"}) {
    if (fs::exists(root / from / header)) return (fs::path(from) / header).parent_path().string();
  }
  return "";
}

}  // namespace priamos
