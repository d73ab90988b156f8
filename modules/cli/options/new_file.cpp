#include "cli/options/new_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/input/regular_file.hpp"

namespace priamos::cli {
namespace {

/// Devices that are memory, of which nobody waits for anything: /dev/null, /dev/full.
bool IsMemoryDevice(const std::string& path) {
  constexpr unsigned kMemory = 1;  // Documentation/admin-guide/devices.txt of the kernel
  struct stat info {};
  return stat(path.c_str(), &info) == 0 && S_ISCHR(info.st_mode) && major(info.st_rdev) == kMemory;
}

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

void RequireFileOrNothing(const std::string& path) {
  const std::string other = OtherThanAFileAt(path);
  if (other.empty() || IsMemoryDevice(path)) return;
  throw std::runtime_error(fmt::format("{}: expected a new file, or one to replace, got {}", path, other));
}

NewFile::NewFile(std::string path) : path_(std::move(path)), written_(Beside(path_)) {
  RequireFileOrNothing(path_);
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
