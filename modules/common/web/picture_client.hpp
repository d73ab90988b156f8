#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/time.hpp"

namespace priamos {

/// Where pictures are fetched.
struct PictureAddress {
  std::string host, port;
  std::string authority;  ///< both as they were written
  std::string target;     ///< `/NAME.jpg`, with `?token=...` where one is needed
};

/// Reads `http://HOST:PORT`, without a target; nullopt for anything else.
std::optional<PictureAddress> ReadPictureAddress(const std::string& text);

/// A picture that was fetched.
struct FetchedPicture {
  std::string jpeg;
  Time exposed{};  ///< by the clock of who fetched it; it was no earlier
};

/// Fetches pictures from a WebServer one after the other, in the calling thread: nothing happens but within
/// Poll. Each is asked for when the one before has come, so none waits in a line, and how old one is follows
/// from this end's clock alone (see PictureHead).
class PictureClient {
 public:
  explicit PictureClient(PictureAddress from);
  ~PictureClient();
  PictureClient(const PictureClient&) = delete;
  PictureClient& operator=(const PictureClient&) = delete;

  /// Does what is to be done without waiting. Not wanted: the connection is closed.
  void Poll(bool wanted, Time now);
  /// The newest picture, once.
  std::optional<FetchedPicture> Take();
  /// Why nothing comes although it is wanted; empty: it comes, or was not wanted yet.
  const std::string& problem() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace priamos
