#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace priamos::cli {

/// One pseudo terminal, found under the name of a symbolic link. What a program writes to the link's target
/// comes out of Read().
class PseudoTerminal {
 public:
  /// Replaces a link left behind; throws std::runtime_error when something else has the name.
  explicit PseudoTerminal(std::string link);
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;
  ~PseudoTerminal();

  int fd() const { return master_; }
  std::vector<std::byte> Read(std::size_t most);
  /// Writes bytes; those that no program reads are lost, as on a modem.
  void Write(std::span<const std::byte> bytes);

 private:
  std::string link_;
  std::string target_;
  int master_ = -1;
  int slave_ = -1;  ///< kept open, so that the line survives the programs at its ends
};

}  // namespace priamos::cli
