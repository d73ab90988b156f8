#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bus/log/log_writer.hpp"
#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

/// Largest resident memory of `priamos log WORDS` [kB]; a large number when it fails. A small program starts
/// it: what this one has in memory would count as well.
long MostMemory(const std::string& words) {
  const std::string measure =
      "import resource, subprocess, sys\n"
      "failed = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL).returncode\n"
      "print(10**9 if failed else resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)\n";
  return std::stol(
      RunShell("python3 -c '" + measure + "' " PRIAMOS_BINARY_DIR "/bin/priamos log " + words).text);
}

TEST(LogMemory, ALogLargerThanTheMemoryAllowedIsIndexedFilteredAndRepaired) {
  const TemporaryFolder folder;
  const std::string log = folder / "large.lcmlog", out = folder / "out";
  {
    bus::LogWriter writer(log);
    const std::vector<std::byte> image(std::size_t{1} << 20, std::byte{1}), pose(100);
    for (int i = 0; i < 150; ++i) {
      writer.Write(2 * i, "IMAGE", image);
      writer.Write(2 * i + 1, "POSE", pose);
    }
  }
  for (const std::string& words :
       {"index " + log + " --out " + out + " --force",
        "filter " + log + " " + out + " --force --channels POSE", "repair " + log + " " + out + " --force"})
    EXPECT_LE(MostMemory(words), 64 * 1024) << words;
}

}  // namespace
}  // namespace priamos
