#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "head/see.hpp"

namespace priamos::cli {

void AddSeeCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<head::SeeOptions>();
  auto* verb = cli.add_subcommand("see", "Draw the edge segments of photographs; no robot needed.");
  verb->footer("Example: priamos see left.jpg right.jpg --json segments.json");
  verb->add_option("image", options->images, "image files")->required();
  verb->add_option("--out", options->folder, "folder for the drawings")
      ->capture_default_str()
      ->check(CLI::ExistingDirectory);
  verb->add_option("--json", options->json, "write the segments with sub-pixel ends there");
  verb->callback([options, &exit_code] {
    head::See(*options);
    exit_code = 0;
  });
}

}  // namespace priamos::cli
