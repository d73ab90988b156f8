#include "head/files/camera_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/config.hpp"

namespace priamos::head {
namespace {

/// A finite number that takes all of the word; YAML allows a plus sign.
std::optional<double> NumberOf(const std::string& word) {
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  double number = 0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace

const CameraEntry* CameraValues::Find(const std::string& below,
                                      std::initializer_list<const char*> keys) const {
  const std::string root = below.empty() ? "" : below + "/";
  for (const char* key : keys)
    for (const char* data : {"", "/data"}) {
      const auto entry = std::ranges::find(entries_, root + key + data, &CameraEntry::key);
      if (entry != entries_.end() && !entry->words.empty()) return &*entry;
    }
  return nullptr;
}

std::vector<double> CameraValues::Numbers(const std::string& below, std::initializer_list<const char*> keys,
                                          std::size_t count) const {
  const CameraEntry* entry = Find(below, keys);
  const std::string what = count == 1   ? "a number"
                           : count == 0 ? "numbers"
                                        : fmt::format("{} numbers", count);
  if (entry == nullptr) Fail(fmt::format("{}: expected {}, got none", *keys.begin(), what));
  if (count != 0 && entry->words.size() != count)
    Fail(*entry, fmt::format("expected {}, got {}", what, entry->words.size()));
  std::vector<double> numbers;
  for (const std::string& word : entry->words) {
    const auto number = NumberOf(word);
    if (!number) Fail(*entry, fmt::format("expected {}, got \"{}\"", what, word.substr(0, 40)));
    numbers.push_back(*number);
  }
  return numbers;
}

Eigen::Matrix3d CameraValues::Matrix(const std::string& below,
                                     std::initializer_list<const char*> keys) const {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(Numbers(below, keys, 9).data());
}

Eigen::Matrix<double, 3, 4> CameraValues::Projection(const std::string& below,
                                                     std::initializer_list<const char*> keys) const {
  return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(Numbers(below, keys, 12).data());
}

void CameraValues::Fail(const CameraEntry& at, const std::string& what) const {
  const std::string place = at.line > 0 ? fmt::format("{}:{}", file_, at.line) : file_;
  throw ConfigError(fmt::format("{}: {}: {}", place, at.key, what));
}

void CameraValues::Fail(const std::string& what) const {
  throw ConfigError(fmt::format("{}: {}", file_, what));
}

}  // namespace priamos::head
