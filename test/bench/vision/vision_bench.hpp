#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/bench/figures.hpp"

namespace priamos::bench {

/// What a run of the bench is asked to do.
struct VisionOptions {
  bool quick = false;               ///< a tenth of the samples
  bool verbose = false;             ///< a line per look
  std::uint64_t seed = 1000;        ///< of the first look at a door
  std::vector<std::string> photos;  ///< for times; scaled to 768 x 576
  std::vector<std::string> pairs;   ///< left, right, camera of the left, of the right: rectified photographs
};

/// Time, accuracy and completeness of the edge operator, beside OpenCV's LSD and EdgeDrawing.
void BenchEdges(const VisionOptions& options, Figures& figures);

/// Wrong matches of edges with three cameras against two: simulated edges, and rendered rooms with the truth
/// from their geometry.
void BenchStereo(const VisionOptions& options, Figures& figures);

/// Stereo matches when one camera is brighter, darker, has another tone curve or loses light in the corners.
void BenchPhotometry(const VisionOptions& options, Figures& figures);

/// Pairs that are exchanged, or one image twice, or nearly so, and right ones: which are refused.
void BenchOrder(const VisionOptions& options, Figures& figures);

/// Fixes at the door from rendered stereo pairs, beside ViSP's edge tracker where it is installed.
void BenchDoor(const VisionOptions& options, Figures& figures);

/// Finding cupboards of the map, and scenes that deceive: absent, another one, half hidden, nearly dark.
void BenchCupboard(const VisionOptions& options, Figures& figures);

/// Several looks at one door, combined by the robot's filter: is its covariance honest?
void BenchRepeated(const VisionOptions& options, Figures& figures);

/// Where the error of a fix comes from: each source of errors alone, beside what an efficient estimator could
/// reach (Cramer-Rao).
void BenchBudget(const VisionOptions& options, Figures& figures);

/// The door from near and far, with one setting of zoom and focus for all looks, and with one chosen for
/// each.
void BenchLens(const VisionOptions& options, Figures& figures);

/// The doors of made-up buildings, whose plan a person with a tape made; absent, or another one in its place.
void BenchRooms(const VisionOptions& options, Figures& figures);

/// Scenes without the door, with another one, half hidden, with the leaf anywhere, nearly dark.
void BenchDeceptions(const VisionOptions& options, Figures& figures);

/// Landmarks looked at before, with and without what these looks showed of the grey values beside edges; in
/// their place what deceives, or in other light.
void BenchGreys(const VisionOptions& options, Figures& figures);

/// The door with its leaf at any angle, which the map tells, or not, or wrongly.
void BenchLeaves(const VisionOptions& options, Figures& figures);

/// Free bodies of many shapes, drawn with labels among others: sharp and blurred, from near and from far
/// beside the truth, absent, or another one in their place.
void BenchBodies(const VisionOptions& options, Figures& figures);

/// A free polyhedron with six degrees of freedom: ViSP's castle sequence with its own truth
/// (visp-images-data).
void BenchCastle(const VisionOptions& options, Figures& figures);

/// Doors that no map told of, one before the head or none.
void BenchDetection(const VisionOptions& options, Figures& figures);

/// Doors that no map told of, in corridors with many of them and what resembles them.
void BenchCorridor(const VisionOptions& options, Figures& figures);

/// The same corridors in one image, or a pair, of cameras that somebody holds in a hand.
void BenchOneImage(const VisionOptions& options, Figures& figures);

/// What stands in made-up rooms beside walls and doors: boxes found, phantoms, errors of their fronts.
void BenchScene(const VisionOptions& options, Figures& figures);

/// Tables that a base comes to, squarely and obliquely, and what hangs nowhere.
void BenchTables(const VisionOptions& options, Figures& figures);

/// Obstacles by the line laser: precision, false alarms, how low they may be.
void BenchLaser(const VisionOptions& options, Figures& figures);

}  // namespace priamos::bench
