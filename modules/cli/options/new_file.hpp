#pragma once

#include <string>

namespace priamos::cli {

/// Checks that `path` is a regular file, or nothing: who opens a pipe waits for somebody, and a device may do
/// something. Devices that are memory, as /dev/null, are taken. Throws std::runtime_error with one sentence.
void RequireFileOrNothing(const std::string& path);

/// A file that is written whole or not at all: its content goes beside it, and takes its place when all of it
/// is there. Whatever fails before that leaves an older file of that name as it was.
class NewFile {
 public:
  /// `path`: what it will be called. /dev/null and the like are written as they are. Throws
  /// std::runtime_error when nothing can be written there, as RequireFileOrNothing does, too.
  explicit NewFile(std::string path);
  /// Takes the content away when it was not kept.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Where the content is to be written.
  const std::string& written() const { return written_; }
  /// Puts the written and closed content in its place. Throws std::runtime_error when that fails.
  void Keep();

 private:
  std::string path_, written_;
};

}  // namespace priamos::cli
