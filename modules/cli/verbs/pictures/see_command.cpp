#include <CLI/App.hpp>
#include <iostream>

#include "cli/options/verb_setup.hpp"
#include "cli/verbs/pictures/commands.hpp"
#include "head/see/see.hpp"

namespace priamos::cli {

namespace {

void AddImageOptions(CLI::App& verb, head::SeeOptions& options) {
  verb.add_option("image", options.images, "image files")->required();
  verb.add_option(
          "--cameras", options.cameras,
          "cameras of the images, in their order, or one file with all: camera_info of ROS, YAML or XML of "
          "OpenCV, XML of ViSP, or what `priamos calibrate` wrote")
      ->expected(1, 3);
  verb.add_flag("--rectified", options.are_rectified,
                "the images were rectified by the cameras' projection_matrix; without it they are as taken");
  verb.add_flag("--doors", options.doors,
                "look for doors in one image or two; which way is up is found in the images, where "
                "that is within 34 degrees of up in the picture, and the height "
                "above the floor as far as they tell it");
  verb.add_option("--stand", options.stand,
                  "look for doors: height of the left camera above the floor [m], its tilt and roll [deg, "
                  "down and to the right are positive]; with --doors the height alone leaves these to the "
                  "images")
      ->expected(1, 3);
  verb.add_option("--max-door-width", options.max_door_width_m, "wider openings are no doors [m]")
      ->capture_default_str()
      ->check(CLI::Range(0.5, 5.0));
  auto* at =
      verb.add_option("--at", options.at,
                      "where the landmark is believed to be, in the first camera's frame: x y z [m] roll "
                      "pitch yaw [deg]")
          ->expected(6);
  verb.add_option(
          "--landmark", options.landmark,
          "a body of flat faces to look for, .toml or ViSP's .cao; one image with its camera is enough")
      ->needs(at);
}

void AddResultOptions(CLI::App& verb, head::SeeOptions& options) {
  verb.add_option("--output", options.output,
                  "folder, or for a single drawing file, of the drawings; without it they lie beside their "
                  "images as IMAGE-edges.png");
  verb.add_flag("--force", options.force, "replace drawings and lists that are there already");
  verb.add_option("--json", options.json,
                  "write segments, corners, outlines and matches there; -: to standard output");
}

}  // namespace

void AddSeeCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<head::SeeOptions>();
  auto* verb =
      AddVerb(cli, "see",
              "Draw edges, corners and parallelograms of photographs, and what a stereo pair has in common.");
  verb->footer(
      "Examples: priamos see photo.jpg --json edges.json\n"
      "          priamos see left.jpg right.jpg --cameras left.yaml right.yaml\n"
      "          priamos see left.jpg right.jpg --cameras left.yaml right.yaml --stand 1.2 -5\n"
      "          priamos see photo.jpg --cameras camera.yaml --doors\n"
      "          priamos see photo.png --cameras camera.yaml --landmark body.cao --at 0.05 0.1 0.6 115 0 0");
  AddImageOptions(*verb, *options);
  AddResultOptions(*verb, *options);
  verb->callback([options, &exit_code] {
    const head::SeeReport report = head::See(*options);
    std::cerr << report.notes;
    std::cout << report.json;
    (report.json.empty() ? std::cout : std::cerr) << report.text;
    exit_code = report.found ? 0 : 1;
  });
}

}  // namespace priamos::cli
