#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// Whether the small end fits a microcontroller, and whether the example of its README works.

namespace priamos {
namespace {

const std::string kTiny = std::string(PRIAMOS_SOURCE_DIR) + "/bus/radio/tiny";
constexpr int kMostCode = 16'000, kMostRam = 4'000;

int LastNumber(const std::string& text, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? std::stoi(match[1]) : -1;
}

/// Stack of each function of the small end, by its name.
std::map<std::string, int> StackUsage(const std::string& folder) {
  std::map<std::string, int> usage;
  std::istringstream lines(RunShell("cat " + folder + "/*.su").text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, std::regex(".*:([A-Za-z0-9_]+)\t([0-9]+)\t.*")))
      usage[match[1]] = std::stoi(match[2]);
  }
  return usage;
}

TEST(TinySize, FitsAMicrocontroller) {
  const TemporaryFolder folder;
  const std::string at = folder.path().string();
  const std::string compile =
      "arm-none-eabi-gcc -std=c99 -Os -mthumb -mcpu=cortex-m3 -ffreestanding -I" + kTiny;
  std::ofstream(at + "/ram.c") << "#include \"priamos_radio.h\"\nchar ram[sizeof(pr_end)] = {1};\n";
  const ShellAnswer built =
      RunShell("cd " + at + " && " + compile + " -fstack-usage -c " + kTiny +
               "/*.c && arm-none-eabi-size -t *.o && " + compile + " -c ram.c && arm-none-eabi-size ram.o");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  const int code = LastNumber(built.text, "([0-9]+)[^\n]*\\(TOTALS\\)");
  const int end = LastNumber(built.text, "\\(TOTALS\\)\n[^\n]*\n *[0-9]+\t *([0-9]+)");
  auto stack = StackUsage(at);
  // Those that hold each other while a frame is checked, which is the deepest.
  const int deepest = stack.at("pr_receive") + stack.at("pr_open") + stack.at("Authenticate") +
                      stack.at("pr_blake2b_update") + stack.at("Compress");
  std::printf("code %d, end %d, stack %d bytes\n", code, end, deepest);
  EXPECT_GT(code, 5'000);
  EXPECT_LE(code, kMostCode);
  EXPECT_GT(end, 1'000);
  EXPECT_LE(end + deepest, kMostRam);
}

TEST(TinySize, TheExampleOfTheReadmeRuns) {
  std::ifstream in(kTiny + "/README.md");
  std::string line, example;
  while (std::getline(in, line) && line != "```c") {
  }
  while (std::getline(in, line) && line != "```") example += line + "\n";
  const TemporaryFolder folder;
  const std::string at = folder.path().string();
  std::ofstream(at + "/example.c") << example;
  const ShellAnswer ran = RunShell("cd " + at + " && gcc -std=c99 -Wall -Wextra -Werror -I" + kTiny +
                                   " example.c " + kTiny + "/*.c -o example && ./example");
  EXPECT_EQ(ran.exit_code, 0) << ran.text;
  EXPECT_GT(LastNumber(ran.text, "([0-9]+) bytes"), 30) << ran.text;  // a hello
}

}  // namespace
}  // namespace priamos
