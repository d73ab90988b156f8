#include "cli/options/new_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace priamos::cli {
namespace {

/// Beside the file that is meant, also when its name is a link: a new name in another folder replaces
/// nothing.
std::string Beside(const std::string& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return path;
  const auto real = std::filesystem::weakly_canonical(path, none);
  return fmt::format("{}.{}.part", none ? path : real.string(), getpid());
}

}  // namespace

NewFile::NewFile(std::string path) : path_(std::move(path)), written_(Beside(path_)) {
  if (written_ == path_ || std::ofstream(written_)) return;
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

NewFile::~NewFile() {
  std::error_code none;
  if (written_ != path_) std::filesystem::remove(written_, none);
}

void NewFile::Keep() {
  if (written_ == path_) return;
  std::error_code error, none;
  auto target = std::filesystem::weakly_canonical(path_, none);
  if (none) target = path_;
  std::filesystem::rename(written_, target, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_, error.message()));
  written_ = path_;
}

}  // namespace priamos::cli
