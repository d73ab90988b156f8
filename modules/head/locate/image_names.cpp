#include "head/locate/image_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <istream>
#include <string_view>

#include "common/config.hpp"
#include "head/files/model_text.hpp"

namespace priamos::head {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLines = "-";
constexpr std::size_t kLongestName = 4096;  ///< of a path in Linux
constexpr std::array<std::string_view, 9> kKinds{".png", ".jpg", ".jpeg", ".tif", ".tiff",
                                                 ".pgm", ".ppm", ".pnm",  ".bmp"};

bool IsDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool IsImageName(const fs::path& file) {
  return std::ranges::find(kKinds, ExtensionOf(file)) != kKinds.end();
}

std::vector<std::string> ImagesOf(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (IsImageName(it->path())) names.push_back(it->path());
  if (error) throw ConfigError(fmt::format("{}: cannot be read: {}", folder, error.message()));
  if (names.empty()) throw ConfigError(fmt::format("{}: expected images in the folder, got none", folder));
  std::ranges::sort(names, ComesBefore);
  return names;
}

/// The digits at the front without leading zeros, taken off `text`.
std::string_view TakeNumber(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, IsDigit);
  std::string_view number(text.begin(), end);
  text.remove_prefix(number.size());
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

}  // namespace

bool ComesBefore(const std::string& a, const std::string& b) {
  std::string_view x = a, y = b;
  while (!x.empty() && !y.empty()) {
    if (IsDigit(x.front()) && IsDigit(y.front())) {
      const std::string_view m = TakeNumber(x), n = TakeNumber(y);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
      continue;
    }
    if (x.front() != y.front()) return x.front() < y.front();
    x.remove_prefix(1);
    y.remove_prefix(1);
  }
  return x.size() != y.size() ? x.size() < y.size() : a < b;
}

ImageNames::ImageNames(const std::vector<std::string>& given, std::istream& lines) : lines_(lines) {
  for (const std::string& name : given) {
    std::error_code none;
    if (!fs::is_directory(name, none)) {
      left_.push_back(name);
      continue;
    }
    for (const std::string& image : ImagesOf(name)) left_.push_back(image);
  }
}

std::optional<std::string> ImageNames::NextLine() {
  std::string line;
  for (char c; lines_.get(c);) {
    if (c != '\n') {
      line += c;
    } else if (!line.empty()) {
      return line;
    }
    if (line.size() > kLongestName)
      throw ConfigError(
          fmt::format("-: expected names of at most {} bytes, one per line, got a longer one", kLongestName));
  }
  if (line.empty()) return std::nullopt;
  return line;
}

std::optional<std::string> ImageNames::NextName() {
  if (left_.empty()) return std::nullopt;
  if (left_.front() != kLines) {
    std::string name = std::move(left_.front());
    left_.pop_front();
    return name;
  }
  if (auto line = NextLine()) return line;
  left_.pop_front();
  return NextName();
}

std::optional<std::vector<std::string>> ImageNames::Next(std::size_t n) {
  std::vector<std::string> names;
  while (names.size() < n) {
    auto name = NextName();
    if (!name && names.empty()) return std::nullopt;
    if (!name)
      throw ConfigError(
          fmt::format("{}: expected {} images of one moment, got {}", names.front(), n, names.size()));
    names.push_back(std::move(*name));
  }
  return names;
}

}  // namespace priamos::head
