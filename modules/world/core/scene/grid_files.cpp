#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "world/core/scene/occupancy_grid.hpp"

namespace priamos::world {
namespace {

constexpr int kMostPixels = 8192;
constexpr int kWhite = 255;

std::string_view Trimmed(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  if (text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
    text = text.substr(1, text.size() - 2);
  return text;
}

/// One line `key: value` of a YAML file.
struct YamlLine {
  const std::string& file;
  int number;
  std::string_view key, value;

  [[noreturn]] void Refuse(std::string_view expected) const {
    throw ConfigError(fmt::format("{}:{}: {}: expected {}, got \"{}\"", file, number, key, expected, value));
  }
  double Number(std::string_view text, double low, double high, std::string_view expected) const {
    text = Trimmed(text);
    double number_value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number_value);
    if (error != std::errc() || end != text.data() + text.size() || !(number_value >= low) ||
        !(number_value <= high))
      Refuse(expected);
    return number_value;
  }
};

std::array<double, 3> ThreeNumbers(const YamlLine& line) {
  constexpr std::string_view kExpected = "[x, y, yaw]";
  std::string_view rest = line.value;
  if (rest.size() < 2 || rest.front() != '[' || rest.back() != ']') line.Refuse(kExpected);
  rest = rest.substr(1, rest.size() - 2);
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == rest.npos) != (i == 2)) line.Refuse(kExpected);
    numbers[i] = line.Number(rest.substr(0, comma), -1e4, 1e4, kExpected);
    rest = comma == rest.npos ? "" : rest.substr(comma + 1);
  }
  return numbers;
}

void Take(const YamlLine& line, GridHeader& header) {
  if (line.key == "image") {
    header.image = line.value;
  } else if (line.key == "resolution") {
    header.resolution_m = line.Number(line.value, 0.005, 1, "a number of 0.005 to 1 [m per pixel]");
  } else if (line.key == "origin") {
    const auto origin = ThreeNumbers(line);
    header.map_from_grid = {origin[0], origin[1], WrapAngle(origin[2])};
  } else if (line.key == "negate") {
    header.negate = line.Number(line.value, 0, 1, "0 or 1") != 0;
  } else if (line.key == "occupied_thresh") {
    header.occupied_thresh = line.Number(line.value, 0, 1, "a number of 0 to 1");
  } else if (line.key == "mode") {
    if (line.value != "trinary") line.Refuse("trinary");
  } else if (line.key != "free_thresh") {
    line.Refuse("no key but image, resolution, origin, negate, occupied_thresh, free_thresh and mode");
  }
}

/// The tokens at the head of a PGM, where `#` begins a comment.
class PgmReader {
 public:
  PgmReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  [[noreturn]] void Refuse(std::string_view expected) const {
    throw ConfigError(fmt::format("{}: byte {}: expected {}", file_, at_, expected));
  }
  std::string_view Word() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (std::isspace(static_cast<unsigned char>(text_[at_])))
        ++at_;
      else
        break;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])) && text_[at_] != '#')
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  int Number(int low, int high, std::string_view what) {
    const std::string_view word = Word();
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < low || number > high)
      Refuse(fmt::format("{} of {} to {}", what, low, high));
    return number;
  }
  /// The bytes after the one that ends the head.
  std::string_view Bytes(std::size_t count) {
    if (text_.size() < at_ + 1 + count)
      Refuse(
          fmt::format("{} bytes of pixels, got {}", count, text_.size() - std::min(text_.size(), at_ + 1)));
    return text_.substr(at_ + 1, count);
  }

 private:
  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

GridHeader ParseGridHeader(const std::string& file, std::string_view text) {
  GridHeader header;
  std::set<std::string_view> keys;
  int number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = Trimmed(text.substr(0, std::min(text.find('#'), end)));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line == "---") continue;
    const std::size_t colon = line.find(':');
    const YamlLine yaml{file, number, Trimmed(line.substr(0, colon)),
                        colon == line.npos ? "" : Trimmed(line.substr(colon + 1))};
    if (colon == line.npos) yaml.Refuse("`key: value`");
    if (!keys.insert(yaml.key).second) yaml.Refuse("each key once");
    Take(yaml, header);
  }
  if (header.image.empty())
    throw ConfigError(fmt::format("{}: image: expected the name of a PGM file, got none", file));
  if (header.resolution_m == 0)
    throw ConfigError(fmt::format("{}: resolution: expected metres per pixel, got none", file));
  return header;
}

OccupancyGrid ParseGrid(const GridHeader& header, const std::string& file, std::string_view pgm) {
  PgmReader reader(file, pgm);
  const std::string_view kind = reader.Word();
  if (kind != "P5" && kind != "P2") reader.Refuse("a grey PGM, which begins with P5 or P2");
  OccupancyGrid grid{header, reader.Number(1, kMostPixels, "a width"), 0, {}};
  grid.height = reader.Number(1, kMostPixels, "a height");
  const int white = reader.Number(1, kWhite, "a largest grey level");
  const std::size_t count = std::size_t(grid.width) * grid.height;
  const std::string_view bytes = kind == "P5" ? reader.Bytes(count) : "";
  grid.occupied.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int grey =
        kind == "P5" ? static_cast<unsigned char>(bytes[i]) : reader.Number(0, white, "a grey level");
    const double bright = double(grey) / white, occupied = header.negate ? bright : 1 - bright;
    // The first row of the picture is the uppermost.
    const std::size_t row = grid.height - 1 - i / grid.width, column = i % grid.width;
    grid.occupied[row * grid.width + column] = occupied > header.occupied_thresh;
  }
  return grid;
}

}  // namespace priamos::world
