#include "bus/host/clock_anchor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "bus/host/host_identity.hpp"

namespace priamos::bus {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeading = "priamos clock anchor 1\n";
constexpr std::int64_t kLatest_us = 7'258'118'400'000'000;  // the year 2200
constexpr std::size_t kMostBytes = 128;
constexpr mode_t kOthersMayWrite = S_IWGRP | S_IWOTH;

/// A file descriptor that is closed at the end.
struct File {
  explicit File(int descriptor) : fd(descriptor) {}
  ~File() {
    if (fd >= 0) close(fd);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int fd;
};

[[noreturn]] void Refuse(const fs::path& path, std::string_view expected, std::string_view got) {
  throw std::runtime_error(fmt::format("{}: expected {}, got {}", path.string(), expected, got));
}

/// Throws unless the folder is there and nobody but root, this user or its rightful owner can write into it.
struct stat RequireFolder(const AnchorFolder& folder) {
  struct stat status {};
  if (lstat(folder.path.c_str(), &status) != 0)
    Refuse(folder.path, "a folder for the clock's anchor", std::strerror(errno));
  if (!S_ISDIR(status.st_mode)) Refuse(folder.path, "a folder", "something else");
  const bool ours = status.st_uid == 0 || status.st_uid == geteuid() || folder.trusted_place;
  if (!ours || (status.st_mode & kOthersMayWrite) != 0)
    Refuse(folder.path, "a folder into which only its owner, this user or root, may write", "another");
  return status;
}

Duration Parse(const fs::path& path, std::string_view text) {
  std::int64_t offset_us = -1;
  const bool headed = text.starts_with(kHeading) && text.ends_with('\n');
  if (headed) {
    const std::string_view number = text.substr(kHeading.size(), text.size() - kHeading.size() - 1);
    const auto end = std::from_chars(number.data(), number.data() + number.size(), offset_us).ptr;
    if (end != number.data() + number.size()) offset_us = -1;
  }
  if (offset_us < 0 || offset_us > kLatest_us)
    Refuse(path, "an anchor of the clock, microseconds since 1970", "something else");
  return Duration(offset_us);
}

/// The anchor in a file; nullopt when there is no file. Throws when it must not be used.
std::optional<Duration> ReadAnchor(const fs::path& path, uid_t owner_of_folder) {
  // Without blocking: a pipe of that name must not stop the process.
  const File file(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.fd < 0 && errno == ENOENT) return std::nullopt;
  if (file.fd < 0) Refuse(path, "a file that can be read", std::strerror(errno));
  struct stat status {};
  fstat(file.fd, &status);
  const bool ours = status.st_uid == 0 || status.st_uid == geteuid() || status.st_uid == owner_of_folder;
  if (!S_ISREG(status.st_mode) || !ours || (status.st_mode & kOthersMayWrite) != 0)
    Refuse(path, "a file of root or of this user that nobody else may write", "another");
  std::array<char, kMostBytes + 1> text{};
  const ssize_t size = read(file.fd, text.data(), text.size());
  if (size < 0 || size > static_cast<ssize_t>(kMostBytes))
    Refuse(path, fmt::format("at most {} bytes", kMostBytes), size < 0 ? std::strerror(errno) : "more");
  return Parse(path, {text.data(), static_cast<std::size_t>(size)});
}

/// Writes the whole file under another name first and links it: nobody reads half of one, and of several
/// processes that start at once one is first. False when that was another.
bool WriteAnchor(const fs::path& path, Duration anchor, bool readable_by_all) {
  std::string draft = path.string() + ".XXXXXX";
  const std::string text = fmt::format("{}{}\n", kHeading, anchor.count());
  {
    const File file(mkostemp(draft.data(), O_CLOEXEC));
    if (file.fd < 0) Refuse(path, "to write it", std::strerror(errno));
    const bool written = write(file.fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                         (!readable_by_all || fchmod(file.fd, 0644) == 0);
    const int error = errno;
    if (!written) unlink(draft.c_str());
    if (!written) Refuse(path, "to write it", std::strerror(error));
  }
  const bool first = link(draft.c_str(), path.c_str()) == 0;
  const int error = errno;
  unlink(draft.c_str());
  if (!first && error != EEXIST) Refuse(path, "to write it", std::strerror(error));
  return first;
}

Duration Agree(const AnchorFolder& folder, const std::string& name, Duration proposal) {
  std::error_code ignored;  // RequireFolder says what is wrong
  if (fs::create_directory(folder.path, ignored))
    fs::permissions(folder.path, static_cast<fs::perms>(folder.readable_by_all ? 0755 : 0700), ignored);
  const uid_t owner = RequireFolder(folder).st_uid;
  const fs::path path = folder.path / name;
  if (const auto known = ReadAnchor(path, owner)) return *known;
  if (WriteAnchor(path, proposal, folder.readable_by_all)) return proposal;
  if (const auto known = ReadAnchor(path, owner)) return *known;
  Refuse(path, "the anchor of the process that was first", "none");
}

}  // namespace

std::vector<AnchorFolder> AnchorFolders() {
  if (const char* chosen = std::getenv("PRIAMOS_RUNTIME"); chosen != nullptr && *chosen != 0)
    return {{chosen, false, false}};
  return {{"/run/priamos", true, true}, {fmt::format("/tmp/priamos-{}", geteuid()), false, false}};
}

std::string AnchorName() {
  const HostIdentity host = ThisHost();
  if (host.boot.empty()) return "";
  struct stat time_namespace {};  // has a boot clock of its own
  stat("/proc/self/ns/time", &time_namespace);
  return fmt::format("clock-{}-{}", host.boot, time_namespace.st_ino);
}

ClockAnchor AgreeOnAnchor(const std::vector<AnchorFolder>& folders, const std::string& name,
                          Duration proposal) {
  ClockAnchor own{proposal, {}, "expected the kernel to say which boot this is, got nothing"};
  if (name.empty()) return own;
  for (const AnchorFolder& folder : folders) {
    try {
      return {Agree(folder, name, proposal), folder.path / name, ""};
    } catch (const std::exception& error) {
      own.problem = error.what();
    }
  }
  return own;
}

}  // namespace priamos::bus
