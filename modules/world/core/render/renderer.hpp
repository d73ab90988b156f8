#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "world/core/camera/imaging.hpp"
#include "world/core/camera/optics.hpp"
#include "world/core/render/laser.hpp"
#include "world/core/scene/moved_solid.hpp"
#include "world/core/scene/placed_reference.hpp"
#include "world/core/scene/scene.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// Everything that determines a picture; the world file's sections [light], [lens] and [head].
struct RendererConfig {
  SceneConfig scene;
  ImagingConfig imaging;
  HeadBuild head;
  std::vector<LaserBuild> lasers = ShippedLasers();  ///< all shine in an exposure with the laser on

  void Describe(Archive& a);
};

/// Poses of base and head at one instant of the exposure.
struct Viewpoint {
  Pose2 map_from_base;
  HeadAxes head;
  std::vector<MovedSolid> moved{};  ///< where the solids are that move by themselves
};

/// Draws the world as the three cameras see it. To be used and destroyed in the thread that made it, whose
/// OpenGL context all Renderers of the thread share. Throws std::runtime_error when no off-screen OpenGL is
/// to be had.
class Renderer {
 public:
  /// Renderer of the solids; `seed` decides textures; materials must be among MaterialNames(), else
  /// std::invalid_argument.
  Renderer(const RendererConfig& config, const std::vector<Solid>& solids, std::uint64_t seed);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Replaces the world, as if newly constructed.
  void SetScene(const RendererConfig& config, const std::vector<Solid>& solids, std::uint64_t seed);
  /// Moves the solid with this name (the door leaf); std::invalid_argument if there is none.
  void MoveSolid(const std::string& name, const Pose2& map_from_solid);
  /// Puts the calibration body somewhere, or takes it away.
  void PlaceReference(const std::optional<PlacedReference>& reference);

  /// One picture of kImageWidth_px x kImageHeight_px, exposed while base and head move evenly from `opening`
  /// to `closing`; solids that move by themselves stand where they are when it closes. The same arguments
  /// give the same bytes; `rng` draws the noise.
  GreyImage Expose(Camera camera, const Viewpoint& opening, const Viewpoint& closing,
                   const Exposure& exposure, Rng& rng);

  const RendererConfig& config() const;

  /// Handle on OpenGL of this thread: while it is held, Renderers made one after the other in this thread
  /// need not set OpenGL up again.
  static std::shared_ptr<void> HoldGraphics();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace priamos::world
