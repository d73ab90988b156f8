#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "head/see.hpp"

namespace priamos::cli {

void AddSeeCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<head::SeeOptions>();
  auto* verb = cli.add_subcommand(
      "see", "Draw edges, corners and parallelograms of photographs, and what a stereo pair has in common.");
  verb->footer(
      "Examples: priamos see photo.jpg --json edges.json\n"
      "          priamos see left.jpg right.jpg --cameras left.yaml right.yaml");
  verb->add_option("image", options->images, "image files")->required();
  verb->add_option(
          "--cameras", options->cameras,
          "rectified cameras of two or three images: YAML with projection_matrix, in the images' order")
      ->expected(2, 3);
  verb->add_option("--out", options->folder, "folder for the drawings")
      ->capture_default_str()
      ->check(CLI::ExistingDirectory);
  verb->add_option("--json", options->json, "write segments, corners, outlines and matches there");
  verb->callback([options, &exit_code] {
    head::See(*options);
    exit_code = 0;
  });
}

}  // namespace priamos::cli
