#include "common/input/private_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "common/input/regular_file.hpp"

namespace priamos {
namespace {

constexpr std::size_t kLongest = 65536;

std::string TextOf(const RegularFile& in, const std::string& file, std::string_view what) {
  if (!in.open())
    throw std::runtime_error(fmt::format("{}: expected a file with {}, got {}", file, what, in.problem()));
  const auto text = in.Read(kLongest);
  if (!text)
    throw std::runtime_error(fmt::format(
        "{}: expected {} of at most {} bytes, got more or a file that cannot be read", file, what, kLongest));
  return *text;
}

}  // namespace

std::string ReadPrivateFile(const std::string& file, std::string_view what) {
  const RegularFile in(file);
  if (in.open() && !in.is_private())
    throw std::runtime_error(
        fmt::format("{}: expected {} that only the owner can read, got mode {:o}; next: chmod 600 {}", file,
                    what, in.mode(), file));
  return TextOf(in, file, what);
}

std::string ReadPublicFile(const std::string& file, std::string_view what) {
  return TextOf(RegularFile(file), file, what);
}

}  // namespace priamos
