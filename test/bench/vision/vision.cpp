// How well the head sees: every figure that is promised, beside the public state of the art on the same
// images in the same run.
//   bench_vision [--quick] [--photo FILE]... [--pair LEFT RIGHT CAMERA CAMERA]... [--only PART]...
// PART: edges, stereo, photometry, order, door, lens, rooms, repeated, cupboard, budget, deceptions, leaves,
// bodies, castle, detection, corridor, oneimage, laser, greys, scene, tables. Prints one line per figure with
// its bound; exit 1 if one is missed.
#include <CLI/CLI.hpp>
#include <opencv2/core/utility.hpp>

#include "test/bench/vision/vision_bench.hpp"

int main(int argc, char** argv) {
  using namespace priamos::bench;
  VisionOptions options;
  std::vector<std::string> only;
  CLI::App app("Figures of seeing");
  app.add_flag("--quick", options.quick, "a tenth of the samples");
  app.add_flag("--verbose", options.verbose, "a line per look at the door");
  app.add_option("--seed", options.seed, "of the first look at the door");
  app.add_option("--photo", options.photos, "photographs to take times on")->check(CLI::ExistingFile);
  app.add_option("--pair", options.pairs, "rectified photographs and their cameras: left, right")
      ->check(CLI::ExistingFile)
      ->expected(4, 400);
  app.add_option("--only", only, "these parts only")
      ->check(
          CLI::IsMember({"edges",     "stereo",   "photometry", "order",      "door",   "lens",   "rooms",
                         "repeated",  "cupboard", "budget",     "deceptions", "leaves", "bodies", "castle",
                         "detection", "corridor", "oneimage",   "laser",      "greys",  "scene",  "tables"}));
  CLI11_PARSE(app, argc, argv);
  cv::setNumThreads(1);
  const auto wanted = [&](std::string_view part) {
    return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
  };
  Figures figures;
  if (wanted("edges")) BenchEdges(options, figures);
  if (wanted("stereo")) BenchStereo(options, figures);
  if (wanted("photometry")) BenchPhotometry(options, figures);
  if (wanted("order")) BenchOrder(options, figures);
  if (wanted("door")) BenchDoor(options, figures);
  if (wanted("lens")) BenchLens(options, figures);
  if (wanted("rooms")) BenchRooms(options, figures);
  if (wanted("repeated")) BenchRepeated(options, figures);
  if (wanted("cupboard")) BenchCupboard(options, figures);
  if (wanted("budget")) BenchBudget(options, figures);
  if (wanted("deceptions")) BenchDeceptions(options, figures);
  if (wanted("leaves")) BenchLeaves(options, figures);
  if (wanted("bodies")) BenchBodies(options, figures);
  if (wanted("castle")) BenchCastle(options, figures);
  if (wanted("detection")) BenchDetection(options, figures);
  if (wanted("corridor")) BenchCorridor(options, figures);
  if (wanted("oneimage")) BenchOneImage(options, figures);
  if (wanted("greys")) BenchGreys(options, figures);
  if (wanted("scene")) BenchScene(options, figures);
  if (wanted("tables")) BenchTables(options, figures);
  if (wanted("laser")) BenchLaser(options, figures);
  return figures.missed() > 0;
}
