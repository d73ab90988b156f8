#pragma once

#include <string>

#include "common/frame_store.hpp"
#include "common/web/web_listener.hpp"
#include "common/web/web_server.hpp"
#include "head/core/look/video_rhythm.hpp"
#include "head/video_config.hpp"

namespace priamos::head {

/// The video link of the third camera, beside the bus: JPEG pictures over HTTP for people who look on.
class VideoLink : public WebListener {
 public:
  /// `robot`: its name, so that nobody takes another robot's pictures for this one's. `token_file`:
  /// config.token_file, resolved. Throws std::runtime_error with one sentence when no port can be had or the
  /// tokens are none.
  VideoLink(const VideoConfig& config, const std::string& robot, const std::string& token_file);

  /// One time step; true: expose the third camera as frame_id(). `needed`: a look uses the cameras.
  bool Step(bool needed, Time now);
  bool Takes(const FrameNotice& frame) { return rhythm_.Takes(frame); }
  std::int32_t frame_id() const { return rhythm_.frame_id(); }
  void Show(Time exposed, const GreyImage& picture);
  /// Where a browser finds it.
  std::string address() const { return server_.address() + camera_ + ".mjpeg"; }

 private:
  void Joined(std::uint64_t, const OpenSocket&) override {}
  bool Said(std::uint64_t, std::string_view, bool) override { return false; }
  void Left(std::uint64_t) override {}

  std::string camera_;
  int quality_;
  VideoRhythm rhythm_;
  WebFiles files_;
  WebServer server_;
};

}  // namespace priamos::head
