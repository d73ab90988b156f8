#include "head/files/model_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "common/input/regular_file.hpp"

namespace priamos::head {

std::string ExtensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Outcome<std::string> ReadText(const std::string& path, std::string_view what, std::size_t most_mb) {
  const RegularFile file(path);
  if (!file.open()) return Refusal{fmt::format("{}: expected {}, got {}", path, what, file.problem())};
  auto text = file.Read(most_mb << 20);
  if (!text) return Refusal{fmt::format("{}: expected {} of at most {} MB", path, what, most_mb)};
  return std::move(*text);
}

}  // namespace priamos::head
