#include <CLI/App.hpp>
#include <iostream>

#include "cli/options/verb_setup.hpp"
#include "cli/verbs/pictures/commands.hpp"
#include "head/locate/locate.hpp"

namespace priamos::cli {
namespace {

void AddImageOptions(CLI::App& verb, head::LocateOptions& options) {
  verb.add_option("image", options.images,
                  "image files, folders of them, or -: their names come on standard input, one per line")
      ->required();
  verb.add_option(
          "--cameras", options.cameras,
          "the camera, or the cameras of images that belong together, in their order: camera_info of ROS, "
          "YAML or XML of OpenCV, XML of ViSP, or what `priamos calibrate` wrote")
      ->expected(1, 3)
      ->required();
  verb.add_option("--at-once", options.n_at_once,
                  "images that belong together, when one file has the cameras of all")
      ->check(CLI::Range(1, 3));
  verb.add_flag("--rectified", options.are_rectified,
                "the images were rectified by the cameras' projection_matrix; without it they are as taken");
}

void AddBodyOptions(CLI::App& verb, head::LocateOptions& options) {
  verb.add_option("--model", options.model, "a body of flat faces: .toml, ViSP's .cao, .obj or .stl")
      ->required();
  verb.add_option("--scale", options.scale, "metres per unit of the model; 0.001 for millimetres")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1e3));
  verb.add_option("--model-sigma", options.model_sigma_m,
                  "how exact the model is, one sigma of an edge's place [m]")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1.0));
  verb.add_option("--at", options.at,
                  "where it is in the beginning, in the first camera's frame: x y z [m] roll pitch yaw [deg]")
      ->expected(6)
      ->required()
      ->check(CLI::Range(-1000.0, 1000.0));
}

/// A share of the distance and an angle, both as one sigma along and about each axis.
void AddSearch(CLI::App& verb, const std::string& name, double& percent, double& deg,
               const std::string& what) {
  verb.add_option_function<std::vector<double>>(
          name,
          [&percent, &deg](const std::vector<double>& given) {
            percent = given.at(0);
            deg = given.at(1);
          },
          what + ", one sigma: percent of the distance, and degrees")
      ->expected(2)
      ->check(CLI::Range(0.01, 20.0))
      ->default_str(CLI::detail::to_string(percent) + " " + CLI::detail::to_string(deg));
}

void AddResultOptions(CLI::App& verb, head::LocateOptions& options) {
  verb.add_option("--json", options.json, "write a line of JSON per moment there; -: to standard output");
  verb.add_option("--draw", options.draw, "draw each moment into that folder, as IMAGE-body.png");
  verb.add_flag("--force", options.force, "replace files that are there already");
}

}  // namespace

void AddLocateCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<head::LocateOptions>();
  auto* verb = AddVerb(cli, "locate",
                       "Find a body of a model file in images, one after the other (exit code 1: in none).");
  verb->footer(
      "Examples: priamos locate photo.png --cameras camera.yaml --model box.stl --scale 0.001 --at 0 0 0.6 "
      "115 0 0\n"
      "          priamos locate film/ --cameras camera.yaml --model box.cao --at 0 0 0.6 115 0 0 --json "
      "film.jsonl\n"
      "          my-camera | priamos locate - --cameras camera.yaml --model box.obj --at 0 0 0.6 115 0 0");
  AddImageOptions(*verb, *options);
  AddBodyOptions(*verb, *options);
  AddSearch(*verb, "--prior", options->prior_percent, options->prior_deg, "how well --at is known");
  AddSearch(*verb, "--motion", options->motion_percent, options->motion_deg,
            "how far the body moves from one image to the next");
  AddResultOptions(*verb, *options);
  verb->callback([options, &exit_code] {
    std::ostream& words = options->json == "-" ? std::cerr : std::cout;
    const head::LocateSinks sinks{[&](const std::string& line) { words << line << std::flush; },
                                  [](const std::string& line) { std::cout << line << std::flush; }};
    exit_code = head::Locate(*options, std::cin, sinks).n_found > 0 ? 0 : 1;
  });
}

}  // namespace priamos::cli
