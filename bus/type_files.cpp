#include "bus/type_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace priamos::bus {

namespace {

/// Paths of all *.lcm below `folder`, sorted. One that is a folder or a device is none; one that leads
/// nowhere is: it cannot be read, and somebody wants to know.
std::set<std::filesystem::path> FindTypeFiles(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> paths;
  std::error_code error, none;
  for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().extension() != ".lcm") continue;
    const auto status = at->status(none);
    if (is_regular_file(status) || !exists(status)) paths.insert(at->path());
  }
  if (error) throw SchemaError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (paths.empty()) throw SchemaError(fmt::format("{}: there is no .lcm file in it", folder.string()));
  return paths;
}

Schema::Source ReadTypeFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw SchemaError(fmt::format("{}: cannot be read", path.string()));
  return {path.string(), std::move(text)};
}

}  // namespace

std::vector<Schema::Source> ReadTypeFiles(const std::filesystem::path& folder) {
  std::vector<Schema::Source> sources;
  for (const auto& path : FindTypeFiles(folder)) sources.push_back(ReadTypeFile(path));
  return sources;
}

std::vector<Schema::Source> ReadTypeFolders(const std::vector<std::string>& folders,
                                            std::vector<std::string>& problems) {
  std::vector<Schema::Source> sources;
  std::set<std::filesystem::path> known;
  for (const std::string& folder : folders)
    for (const auto& path : FindTypeFiles(folder)) {
      std::error_code none;
      if (!known.insert(std::filesystem::weakly_canonical(path, none)).second) continue;
      try {
        sources.push_back(ReadTypeFile(path));
      } catch (const SchemaError& error) {
        problems.emplace_back(error.what());
      }
    }
  return sources;
}

}  // namespace priamos::bus
