#include "radio/key_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>

#include "common/input/quoted.hpp"
#include "common/input/regular_file.hpp"

namespace priamos::radio {
namespace {

using bus::radio::LinkKey;

constexpr std::size_t kHexDigits = 2 * sizeof(LinkKey);

class File {
 public:
  File(const std::string& path, int flags, mode_t mode = 0)
      : fd_(open(path.c_str(), flags | O_CLOEXEC, mode)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (fd_ >= 0) close(fd_);
  }
  int fd() const { return fd_; }

 private:
  int fd_;
};

void RequirePrivate(const RegularFile& file, const std::string& path) {
  if (!file.is_private())
    throw std::runtime_error(
        fmt::format("{}: expected a key that only its owner can read, got mode {:o}: if nobody else has read "
                    "it, `chmod 600 {}`",
                    path, file.mode(), path));
}

/// The digits of a key, with nothing but a line feed behind them; nullopt: something else.
std::optional<LinkKey> KeyOf(const std::string& text) {
  const bool ends = text.size() == kHexDigits || (text.size() == kHexDigits + 1 && text.back() == '\n');
  LinkKey key{};
  std::size_t bytes = 0;
  const bool is_hex =
      ends && sodium_hex2bin(key.data(), key.size(), text.data(), kHexDigits, nullptr, &bytes, nullptr) == 0;
  return is_hex && bytes == key.size() ? std::optional(key) : std::nullopt;
}

/// Whether there is anything of this name, also a link that leads nowhere.
bool IsThere(const std::string& path) {
  struct stat info {};
  return lstat(path.c_str(), &info) == 0 || errno != ENOENT;
}

/// The process that reads the one must be able to read the other, also when root made it.
void GiveToOwnerOf(const std::string& path, const std::string& other) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0 || info.st_uid == geteuid()) return;
  if (chown(other.c_str(), info.st_uid, info.st_gid) != 0)
    throw std::runtime_error(
        fmt::format("{}: cannot be given to the owner of {}: {}", other, path, std::strerror(errno)));
}

/// Whether a key looks random: of 10^16 random keys not one has fewer than 16 different bytes, is a text,
/// repeats itself, or counts in equal steps.
bool LooksRandom(const LinkKey& key) {
  const auto printable = [](unsigned char c) { return std::isprint(c) != 0 || c == 0; };
  std::set<unsigned char> steps;
  for (std::size_t i = 1; i < key.size(); ++i) steps.insert(static_cast<unsigned char>(key[i] - key[i - 1]));
  const auto half = key.begin() + key.size() / 2;
  return std::set(key.begin(), key.end()).size() >= 16 && steps.size() >= 12 &&
         !std::all_of(key.begin(), key.end(), printable) && !std::equal(key.begin(), half, half);
}

/// Beside `path`, under which it appears as a whole or not at all. Returns whether all of it is on the disk.
bool WriteKey(const std::string& aside) {
  std::remove(aside.c_str());  // of a process that was ended in the middle
  const File file(aside, O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (file.fd() < 0) return false;
  LinkKey key{};
  randombytes_buf(key.data(), key.size());
  std::array<char, kHexDigits + 1> text{};
  sodium_bin2hex(text.data(), text.size(), key.data(), key.size());
  text[kHexDigits] = '\n';
  const bool written = write(file.fd(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       fsync(file.fd()) == 0;
  sodium_memzero(text.data(), text.size());
  sodium_memzero(key.data(), key.size());
  return written;
}

}  // namespace

LinkKey ReadKeyFile(const std::string& path) {
  const RegularFile file(path);
  if (!file.open())
    throw std::runtime_error(
        fmt::format("{}: expected the key of the radio link, got {}: make one with `priamos link keygen "
                    "{}` and copy it to the other end",
                    Escaped(path), file.problem(), Escaped(path)));
  RequirePrivate(file, Escaped(path));
  auto text = file.Read(kHexDigits + 1).value_or("");
  const auto key = KeyOf(text);
  sodium_memzero(text.data(), text.size());
  if (!key)
    throw std::runtime_error(
        fmt::format("{}: expected 64 hexadecimal digits, got something else: copy it again from the other "
                    "end",
                    Escaped(path)));
  if (!LooksRandom(*key))
    throw std::runtime_error(fmt::format(
        "{}: expected a random key, got one that can be guessed: make one with `priamos link keygen`",
        Escaped(path)));
  return *key;
}

void WriteNewKeyFile(const std::string& path) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be started");
  if (IsThere(path))
    throw std::runtime_error(
        fmt::format("{}: exists and is kept: a link whose key changes must get the new one at both ends; "
                    "remove it first if that is meant",
                    path));
  const std::string aside = path + ".part";
  if (WriteKey(aside) && renameat2(AT_FDCWD, aside.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0)
    return;
  const int why = errno;
  std::remove(aside.c_str());
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(why)));
}

std::string NextKeyFile(const std::string& path) {
  return path + ".next";
}

std::optional<LinkKey> ReadNextKeyFile(const std::string& path, const LinkKey& current) {
  const std::string next = NextKeyFile(path);
  if (!IsThere(next)) return std::nullopt;
  const LinkKey key = ReadKeyFile(next);
  if (key == current)
    throw std::runtime_error(
        fmt::format("{}: expected another key than {}, got the same: remove it", next, path));
  return key;
}

void WriteNextKeyFile(const std::string& path) {
  ReadKeyFile(path);
  const std::string next = NextKeyFile(path);
  if (IsThere(next))
    throw std::runtime_error(fmt::format(
        "{}: exists and is kept: go on with it (`priamos link rekey --help`), or remove it at both ends",
        next));
  WriteNewKeyFile(next);
  GiveToOwnerOf(path, next);
}

void FinishKeyChange(const std::string& path) {
  const std::string next = NextKeyFile(path);
  if (!IsThere(next))
    throw std::runtime_error(fmt::format(
        "{}: expected the next key, got none: make one with `priamos link rekey {}`", next, path));
  ReadNextKeyFile(path, ReadKeyFile(path));
  // Through symbolic links: the old key is to be gone, and not only the name that led to it.
  const std::filesystem::path from = std::filesystem::canonical(next), to = std::filesystem::canonical(path);
  if (std::rename(from.c_str(), to.c_str()) != 0)
    throw std::runtime_error(fmt::format("{}: cannot be replaced: {}", to.string(), std::strerror(errno)));
  std::remove(next.c_str());  // the link that led to it
  const File directory(to.parent_path().string(), O_RDONLY | O_DIRECTORY);
  if (directory.fd() >= 0) fsync(directory.fd());  // else a loss of power may bring the old key back
}

LinkKey SimulationKey() {
  LinkKey key{};
  constexpr std::string_view kText = "everybody knows this key";
  std::memcpy(key.data(), kText.data(), kText.size());
  return key;
}

}  // namespace priamos::radio
