#include "radio/private_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <fstream>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

TEST(PrivateLine, APseudoTerminalIsOneAlsoThroughALink) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  const TemporaryFolder folder;
  std::filesystem::create_symlink(ptsname(master), folder / "tty");
  EXPECT_TRUE(IsPrivateLine(ptsname(master)));
  EXPECT_TRUE(IsPrivateLine((folder / "tty").string()));
  close(master);
}

TEST(PrivateLine, WhatIsNoPseudoTerminalOrNotThereIsNone) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_FALSE(IsPrivateLine((folder / "file").string()));
  EXPECT_FALSE(IsPrivateLine((folder / "nothing").string()));
  EXPECT_FALSE(IsPrivateLine("/dev/ttyUSB17"));
  EXPECT_FALSE(IsPrivateLine("/dev/pts/../null"));
}

TEST(PrivateLine, AddressesOfThisMachineAloneAreOne) {
  for (const char* port : {"udp:127.0.0.1:9000", "udp:127.9.8.7:9000", "tcp:[::1]:9000",
                           "udp:[::1]:9000@9001", "tcp:localhost:9000", "tcp::9000"})
    EXPECT_TRUE(IsPrivateLine(port)) << port;
}

TEST(PrivateLine, AddressesElsewhereAndUnknownNamesAreNone) {
  for (const char* port :
       {"udp:192.0.2.1:9000", "tcp:10.0.0.1:9000", "udp:0.0.0.0:9000", "udp:128.0.0.1:9000",
        "udp:[2001:db8::1]:9000", "tcp:[::]:9000", "tcp:no-such-host.invalid:9000"})
    EXPECT_FALSE(IsPrivateLine(port)) << port;
}

TEST(PrivateLine, WhatIsNoAddressIsRefused) {
  EXPECT_THROW(IsPrivateLine("udp:9000"), ConfigError);
}

}  // namespace
}  // namespace priamos::radio
