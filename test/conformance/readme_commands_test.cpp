#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "test/support/readme_blocks.hpp"

namespace priamos {
namespace {

namespace fs = std::filesystem;

struct Command {
  std::string file, text;
};

std::vector<fs::path> Readmes() {
  std::vector<fs::path> found;
  for (const fs::path& file : ProjectFiles())
    if (file.filename() == "README.md") found.push_back(PRIAMOS_SOURCE_DIR / file);
  return found;
}

/// Commands in the blocks of a README.
std::vector<Command> ShownCommands(const fs::path& readme) {
  std::vector<Command> found;
  for (const ReadmeBlock& block : BlocksOf(fs::relative(readme, PRIAMOS_SOURCE_DIR)))
    for (const std::string& command : block.commands) found.push_back({readme, command});
  return found;
}

/// `priamos ...` and `scripts/...` in running text.
std::vector<Command> QuotedCommands(const fs::path& readme) {
  std::ostringstream text;
  text << std::ifstream(readme).rdbuf();
  const std::string whole = text.str();
  static const std::regex kQuoted(R"(`((?:priamos(?:-[a-z]+)? |scripts/[a-z])[^`\n]*)`)");
  std::vector<Command> found;
  for (auto it = std::sregex_iterator(whole.begin(), whole.end(), kQuoted); it != std::sregex_iterator();
       ++it)
    found.push_back({readme, (*it)[1]});
  return found;
}

std::vector<std::string> Words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

/// The file behind a command's first word; empty for programs that are not ours.
fs::path ProgramOf(const std::string& word) {
  if (word.starts_with("scripts/")) return fs::path(PRIAMOS_SOURCE_DIR) / word;
  const std::string name = fs::path(word).filename();
  if (name != "priamos" && !name.starts_with("priamos-")) return {};
  return fs::path(PRIAMOS_BINARY_DIR) / "bin" / name;
}

/// What `command` prints, or nothing when it fails.
std::optional<std::string> OutputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"),
                                                   [](FILE*) { return 0; });
  std::string output;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe.get()))
    output.append(buffer.data(), n);
  return pclose(pipe.get()) == 0 ? std::optional(output) : std::nullopt;
}

/// The program with the verbs it was given: `priamos link bits`.
std::string VerbOf(const fs::path& program, const std::vector<std::string>& words) {
  static const std::set<std::string> kVerbsWithVerbs{"link",       "topic",   "log",   "type", "replay",
                                                     "completion", "mission", "world", "map"};
  std::string command = fmt::format("'{}'", program.string());
  if (program.filename() != "priamos" || words.size() < 2 || words[1].starts_with("-")) return command;
  command += " " + words[1];
  if (kVerbsWithVerbs.contains(words[1]) && words.size() > 2 && !words[2].starts_with("-"))
    command += " " + words[2];
  return command;
}

/// The help of each verb, asked for once.
using Helps = std::map<std::string, std::optional<std::string>>;

const std::optional<std::string>& HelpOf(const std::string& verb, Helps& helps) {
  const auto [it, is_new] = helps.try_emplace(verb);
  if (is_new) it->second = OutputOf(verb + " --help");
  return it->second;
}

void Check(const Command& command, Helps& helps) {
  SCOPED_TRACE(fmt::format("{}: {}", command.file, command.text));
  const auto words = Words(command.text);
  const fs::path program = ProgramOf(words.at(0));
  if (program.empty()) return;
  ASSERT_TRUE(fs::is_regular_file(program)) << program << " does not exist";
  ASSERT_NE(fs::status(program).permissions() & fs::perms::owner_exec, fs::perms::none) << "cannot be run";
  if (!program.string().starts_with(PRIAMOS_BINARY_DIR))
    return;  // a script builds first: not from inside a test
  const auto& help = HelpOf(VerbOf(program, words), helps);
  ASSERT_TRUE(help) << "its help cannot be had: no such verb?";
  for (const auto& word : words) {
    if (!word.starts_with("--")) continue;
    EXPECT_NE(help->find(word.substr(0, word.find('='))), std::string::npos) << word << " is not in its help";
  }
}

TEST(ReadmeCommands, EveryCommandShownExistsAndKnowsItsOptions) {
  std::size_t shown = 0;
  Helps helps;
  for (const auto& readme : Readmes())
    for (const auto& commands : {ShownCommands(readme), QuotedCommands(readme)})
      for (const auto& command : commands) {
        Check(command, helps);
        ++shown;
      }
  EXPECT_GE(shown, 10u);
}

TEST(ReadmeCommands, EveryLinkLeadsSomewhere) {
  static const std::regex kLink(R"(\]\(([^)#]+)[^)]*\))");
  for (const auto& readme : Readmes()) {
    std::ostringstream text;
    text << std::ifstream(readme).rdbuf();
    const std::string whole = text.str();
    for (auto it = std::sregex_iterator(whole.begin(), whole.end(), kLink); it != std::sregex_iterator();
         ++it) {
      const std::string target = (*it)[1];
      EXPECT_TRUE(target.starts_with("http") || fs::exists(readme.parent_path() / target))
          << readme << ": " << target;
    }
  }
}

TEST(ReadmeCommands, EveryFolderThatIsARoomHasOne) {
  for (const auto* parent : {"modules", "bus"})
    for (const fs::path& file : ProjectFiles(parent)) {
      const fs::path room = parent / *std::next(file.begin());
      EXPECT_TRUE(room == file || fs::exists(PRIAMOS_SOURCE_DIR / room / "README.md")) << room;
    }
  for (const auto* folder : {".", "lcmtypes", "config", "test"})
    EXPECT_TRUE(fs::exists(fs::path(PRIAMOS_SOURCE_DIR) / folder / "README.md")) << folder;
}

}  // namespace
}  // namespace priamos
