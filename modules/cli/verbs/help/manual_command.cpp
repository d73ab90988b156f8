#include <CLI/App.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "cli/options/verb_setup.hpp"
#include "cli/verbs/help/commands.hpp"
#include "cli/verbs/help/manual.hpp"

namespace priamos::cli {
namespace {

struct ManualOptions {
  std::string folder;
  ManualIssue issue;
};

void Write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

void AddManualCommand(CLI::App& cli, int& exit_code) {
  auto options = std::make_shared<ManualOptions>();
  auto* verb = AddVerb(cli, "manual", "Write the pages of the manual for man(1).");
  verb->group("");  // what the build calls
  verb->add_option("folder", options->folder, "becomes man1/ and man5/ in it")->required();
  verb->add_option("--date", options->issue.date, "YYYY-MM-DD")->required();
  verb->add_option("--release", options->issue.release, "name and version")->required();
  verb->callback([&cli, options, &exit_code] {
    const std::filesystem::path folder = options->folder;
    for (const ManualPage& page : Manual(cli, options->issue))
      Write(folder / ("man" + page.FileName().substr(page.FileName().size() - 1)) / page.FileName(),
            page.Text());
    std::filesystem::remove(folder / "man1/priamos-verbs.1");
    std::filesystem::create_symlink("priamos.1", folder / "man1/priamos-verbs.1");
    exit_code = 0;
  });
}

}  // namespace priamos::cli
