#include "radio/file_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace priamos::radio {

std::optional<std::vector<std::byte>> FileStore::Load() {
  std::ifstream in(path_, std::ios::binary);
  if (!in) return std::nullopt;
  std::vector<std::byte> bytes;
  for (auto at = std::istreambuf_iterator<char>(in); at != std::istreambuf_iterator<char>(); ++at)
    bytes.push_back(static_cast<std::byte>(*at));
  return bytes;
}

void FileStore::Save(std::span<const std::byte> state, bool durable) {
  const std::string next = path_ + ".new";
  const auto fail = [&] {
    throw std::runtime_error(
        fmt::format("{}: the radio's state cannot be saved: {}", path_, std::strerror(errno)));
  };
  const int fd = open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) fail();
  const bool good = write(fd, state.data(), state.size()) == static_cast<ssize_t>(state.size()) &&
                    (!durable || fsync(fd) == 0);
  close(fd);
  if (!good || std::rename(next.c_str(), path_.c_str()) != 0) fail();
  if (!durable) return;
  // The new name must survive a loss of power as well.
  const auto folder = std::filesystem::absolute(path_).parent_path();
  const int folder_fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_fd < 0) return;
  fsync(folder_fd);
  close(folder_fd);
}

}  // namespace priamos::radio
