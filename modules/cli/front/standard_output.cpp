#include "cli/front/standard_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>

namespace priamos::cli {
namespace {

constexpr int kCannotWrite = 2;
constexpr std::size_t kMostWaiting = 1 << 16;  ///< bytes

/// Otherwise the next socket or log would get the number of standard output, and with it the text. What takes
/// the place can be read but not written: text for a closed output is an error and not lost in silence.
void OccupyClosedDescriptors() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
    if (fcntl(fd, F_GETFD) < 0 && errno == EBADF) {
      const int opened = open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
      if (opened >= 0 && opened != fd) close(opened);
    }
}

/// A handler and not SIG_IGN: children do not inherit it, and write() reports EPIPE all the same.
void KeepSigpipeFromKilling() {
  struct sigaction now {};
  if (sigaction(SIGPIPE, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) std::signal(SIGPIPE, [](int) {});
}

void DieOfSigpipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

/// Waits when the output is full for the moment: a pipe or terminal that somebody else made non-blocking.
bool MayBeTriedAgain(int error) {
  if (error != EAGAIN) return error == EINTR;
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  poll(&output, 1, -1);
  return true;
}

/// Whether SIGTERM is blocked, as bus::SignalWatch leaves it.
bool WatchesSignals() {
  sigset_t blocked;
  return pthread_sigmask(SIG_BLOCK, nullptr, &blocked) == 0 && sigismember(&blocked, SIGTERM) == 1;
}

}  // namespace

class StandardOutput::Buffer : public std::streambuf {
 public:
  /// errno of the first failure; 0: none.
  int error() const { return error_; }

 protected:
  int_type overflow(int_type character) override {
    if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
    const char one = traits_type::to_char_type(character);
    return xsputn(&one, 1) == 1 ? character : traits_type::eof();
  }

  std::streamsize xsputn(const char* text, std::streamsize size) override {
    waiting_.append(text, static_cast<std::size_t>(size));
    const bool line = is_terminal_ && waiting_.find('\n') != std::string::npos;
    return (line || waiting_.size() >= kMostWaiting) && sync() != 0 ? 0 : size;
  }

  int sync() override {
    std::string_view left = waiting_;
    while (error_ == 0 && !left.empty()) {
      const ssize_t n = write(STDOUT_FILENO, left.data(), left.size());
      if (n >= 0) left.remove_prefix(static_cast<std::size_t>(n));
      if (n < 0 && !MayBeTriedAgain(errno)) Fail(errno);
    }
    waiting_.clear();
    return error_ == 0 ? 0 : -1;
  }

 private:
  void Fail(int error) {
    error_ = error;
    if (WatchesSignals()) {
      std::raise(SIGTERM);
    } else if (error == EPIPE) {
      DieOfSigpipe();
    }
  }

  const bool is_terminal_ = isatty(STDOUT_FILENO) == 1;
  std::string waiting_;
  int error_ = 0;
};

StandardOutput::StandardOutput() {
  OccupyClosedDescriptors();
  KeepSigpipeFromKilling();
  buffer_ = std::make_unique<Buffer>();
  before_ = std::cout.rdbuf(buffer_.get());
}

StandardOutput::~StandardOutput() {
  std::cout.flush();
  std::cout.rdbuf(before_);
}

int StandardOutput::Finish(const std::string& who, int exit_code) {
  std::cout.flush();
  if (buffer_->error() == 0) return exit_code;
  if (buffer_->error() == EPIPE) DieOfSigpipe();
  std::cerr << fmt::format(
      "{}: standard output cannot be written: {}; next: make room, or write it elsewhere\n", who,
      std::strerror(buffer_->error()));
  return kCannotWrite;
}

}  // namespace priamos::cli
