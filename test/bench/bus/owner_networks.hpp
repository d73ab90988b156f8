#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace priamos::bench {

/// Two computers' networks, joined by a bridge that can be cut. Made inside a private network, of which the
/// caller must be root (scripts/in-private-network); gone with the process.
class TwoNetworks {
 public:
  enum class Side { kLeft, kRight };

  /// Makes the networks. Throws std::runtime_error when the kernel refuses.
  TwoNetworks();
  ~TwoNetworks();
  TwoNetworks(const TwoNetworks&) = delete;
  TwoNetworks& operator=(const TwoNetworks&) = delete;

  void Cut();
  void Join();
  /// Runs `make` in the network of a side; sockets that it opens stay there.
  void In(Side side, const std::function<void()>& make) const;

 private:
  int Make(const std::string& name, const std::string& address) const;

  int hub_, left_, right_;
};

/// A program that was started, with its console in a file. It is killed when it still runs at the end.
class Program {
 public:
  Program(const TwoNetworks& networks, TwoNetworks::Side side, std::vector<std::string> arguments,
          const std::string& console);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  /// True from its end on; `exit_code` is that of a shell, 128 + N after a signal.
  bool Ended();
  int exit_code() const { return exit_code_; }
  std::string Console() const;

 private:
  pid_t pid_ = 0;
  bool ended_ = false;
  int exit_code_ = -1;
  std::string console_;
};

}  // namespace priamos::bench
