#include "bus/type_files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>

namespace priamos::bus {

std::vector<Schema::Source> ReadTypeFiles(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> paths;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().extension() == ".lcm" && at->is_regular_file()) paths.insert(at->path());
  }
  if (error) throw SchemaError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  if (paths.empty()) throw SchemaError(fmt::format("{}: there is no .lcm file in it", folder.string()));
  std::vector<Schema::Source> sources;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw SchemaError(fmt::format("{}: cannot be read", path.string()));
    sources.push_back({path.string(), std::move(text)});
  }
  return sources;
}

}  // namespace priamos::bus
