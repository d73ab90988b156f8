#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/frame_store.hpp"
#include "common/time.hpp"
#include "world/core/camera/imaging.hpp"
#include "world/core/camera/optics.hpp"
#include "world/core/head/gain_drift.hpp"
#include "world/core/render/renderer.hpp"

namespace priamos::world {

/// The cameras' electronics.
struct CameraConfig {
  double trigger_delay_s = 0.004;
  double exposure_s = 0.008;
  double gain = 1;
  double readout_s = 0.04;
  int max_pending = 6;
  double laser = 0.7;  ///< Exposure::laser of a picture that is taken with the laser on

  void Describe(Archive& a);
};

/// One picture to be drawn.
struct RenderJob {
  std::int64_t number = 0;  ///< counts up
  Camera camera = kLeftCamera;
  Viewpoint opening, closing;  ///< at the beginning and the end of the exposure
  Exposure exposure;
  std::uint64_t noise_seed = 0;
};

/// Draws one picture; depends on nothing but the job.
using RenderFunction = std::function<GreyImage(const RenderJob&)>;

/// Draws pictures somewhere, now or later: they come back by their number. What a RenderFunction throws
/// comes out of Take().
class RenderExecutor {
 public:
  virtual ~RenderExecutor() = default;
  virtual void Submit(const RenderJob& job) = 0;
  /// The picture of that job once it is drawn, only once.
  virtual std::optional<GreyImage> Take(std::int64_t number) = 0;
};

/// A picture, or why there is none.
struct DrawnPicture {
  GreyImage image;
  std::exception_ptr error;
};

/// Draws; what `render` throws is kept.
DrawnPicture Draw(const RenderFunction& render, const RenderJob& job);

/// Takes a finished picture out of `done`; throws its error.
std::optional<GreyImage> TakeFrom(std::map<std::int64_t, DrawnPicture>& done, std::int64_t number);

/// Draws at once, in the caller's thread: for simulated time.
class InlineRenderExecutor : public RenderExecutor {
 public:
  explicit InlineRenderExecutor(RenderFunction render) : render_(std::move(render)) {}
  void Submit(const RenderJob& job) override;
  std::optional<GreyImage> Take(std::int64_t number) override;

 private:
  RenderFunction render_;
  std::map<std::int64_t, DrawnPicture> done_;
};

/// A picture that has been read out.
struct Frame {
  Time exposure_middle;
  std::int32_t frame_id = 0;
  Camera camera = kLeftCamera;
  GreyImage image;
};

/// All cameras open and close at one moment, a little after the trigger; the pictures are there after the
/// readout, in the order left, right, third, or as soon as they are drawn if that takes longer. It sees the
/// world only through the viewpoints it is given at the moments it asks for.
class CameraServer {
 public:
  /// Server of the cameras; `executor` must outlive it; `seed` decides the noise of every picture.
  CameraServer(const CameraConfig& config, double camera_light, RenderExecutor& executor, std::uint64_t seed,
               const CameraQuirks& quirks = {});

  /// Bits of `cameras`: 1 left, 2 right, 4 third; 8 with the line laser on. Refused (false) while too many
  /// pictures are pending or when no camera is asked for.
  bool Trigger(Time now, std::int32_t frame_id, int cameras);

  /// The next moment at which Sample() must be called; nullopt while nothing is being exposed.
  std::optional<Time> NextSample() const;
  /// Poses of the cameras at the time of NextSample().
  void Sample(const Viewpoint& viewpoint);

  /// The oldest frame whose readout is over at `now`. Throws what drawing it threw; that frame is lost, the
  /// next call goes on with the next one.
  std::optional<Frame> Collect(Time now);

 private:
  struct Shot {
    Time opening, closing;
    std::int32_t frame_id;
    int cameras;
    bool laser;
    std::optional<Viewpoint> opened;
  };
  struct Pending {
    std::int64_t number;
    Time ready;
    Frame frame;
  };
  void Submit(const Shot& shot, const Viewpoint& closed);

  CameraConfig config_;
  double camera_light_;
  RenderExecutor& executor_;
  std::uint64_t seed_;
  CameraQuirks quirks_;
  GainDrift gain_;
  std::int64_t next_number_ = 0;
  std::deque<Shot> shots_;  ///< in the order of their triggers; one exposure at a time
  std::deque<Pending> pending_;
};

}  // namespace priamos::world
