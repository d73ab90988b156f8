#pragma once

#include <deque>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace priamos::head {

/// The images of a sequence by their names, in their order: files as they are given; a folder stands for its
/// images, numbers in their names counted as numbers; "-" for the lines of a stream, as they come (a camera
/// that writes files and prints their names).
class ImageNames {
 public:
  /// `lines` must outlive this. Throws ConfigError naming a folder without images.
  ImageNames(const std::vector<std::string>& given, std::istream& lines);

  /// The next `n` names; nullopt at the end. Throws ConfigError when fewer than `n` are left, and for a line
  /// that is too long for a name.
  std::optional<std::vector<std::string>> Next(std::size_t n);

 private:
  std::optional<std::string> NextName();
  std::optional<std::string> NextLine();

  std::deque<std::string> left_;
  std::istream& lines_;
};

/// Whether `a` comes before `b`: digits are compared as numbers, everything else byte by byte.
bool ComesBefore(const std::string& a, const std::string& b);

}  // namespace priamos::head
