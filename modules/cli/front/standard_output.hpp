#pragma once

#include <memory>
#include <streambuf>
#include <string>

namespace priamos::cli {

/// Standard output that ends a verb when nothing more can be written to it. While it lives, std::cout writes
/// through it, so no verb has to look at the state of std::cout.
///
/// A verb that watches signals (bus::SignalWatch) gets a SIGTERM at the first failure: it ends in its own
/// order, its processes and logs with it. Any other verb goes on to its end, but when the reader of a pipe
/// has gone it is killed by SIGPIPE, as other programs are.
class StandardOutput {
 public:
  StandardOutput();
  ~StandardOutput();
  StandardOutput(const StandardOutput&) = delete;
  StandardOutput& operator=(const StandardOutput&) = delete;

  /// Writes what is left. Returns `exit_code` if all could be written, otherwise 2, with one sentence that
  /// begins with `who` on standard error. Does not return when the reader of a pipe has gone: that ends the
  /// process quietly, by SIGPIPE.
  int Finish(const std::string& who, int exit_code);

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
  std::streambuf* before_;
};

}  // namespace priamos::cli
