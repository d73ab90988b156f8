#include "radio/key_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

using testing::HasSubstr;

struct KeyFileTest : testing::Test {
  TemporaryFolder folder;
  std::string path = (folder / "link.key").string();
  std::string ErrorOfReading() const {
    try {
      ReadKeyFile(path);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(KeyFileTest, WrittenKeyIsPrivateAndReadBack) {
  WriteNewKeyFile(path);
  struct stat info {};
  ASSERT_EQ(stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0600U);
  EXPECT_EQ(ReadKeyFile(path), ReadKeyFile(path));
}

TEST_F(KeyFileTest, TwoKeysDiffer) {
  WriteNewKeyFile(path);
  const auto first = ReadKeyFile(path);
  std::filesystem::remove(path);
  WriteNewKeyFile(path);
  EXPECT_NE(ReadKeyFile(path), first);
}

TEST_F(KeyFileTest, AnExistingKeyIsKept) {
  WriteNewKeyFile(path);
  EXPECT_THROW(WriteNewKeyFile(path), std::runtime_error);
}

TEST_F(KeyFileTest, AKeyThatOthersCanReadIsRefused) {
  WriteNewKeyFile(path);
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  EXPECT_THAT(ErrorOfReading(), HasSubstr("chmod 600"));
}

/// Its reader would wait for a writer, or for an end.
TEST_F(KeyFileTest, WhatIsNoFileIsRefusedAtOnce) {
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_THAT(ErrorOfReading(), HasSubstr("link.key: expected the key of the radio link, got a pipe"));
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  EXPECT_THAT(ErrorOfReading(), HasSubstr("got a folder"));
  std::filesystem::remove(path);
  std::filesystem::create_symlink("/dev/zero", path);
  EXPECT_THAT(ErrorOfReading(), HasSubstr("got a device"));
}

TEST_F(KeyFileTest, AMissingKeyNamesTheCommand) {
  EXPECT_THAT(ErrorOfReading(), HasSubstr("priamos link keygen"));
}

TEST_F(KeyFileTest, SomethingElseIsRefused) {
  for (const std::string& text :
       {std::string(), std::string("abc"), std::string(64, 'g'), std::string(80, '0')}) {
    std::ofstream(path) << text;
    chmod(path.c_str(), 0600);
    EXPECT_THAT(ErrorOfReading(), HasSubstr("64 hexadecimal digits")) << text;
  }
}

TEST_F(KeyFileTest, AKeyThatCanBeGuessedIsRefused) {
  std::string simulation;
  for (const auto byte : SimulationKey()) simulation += fmt::format("{:02x}", byte);
  std::string pattern;
  while (pattern.size() < 64) pattern += "0123456789abcdef";
  const auto hex = [](const std::string& bytes) {
    std::string text;
    for (const unsigned char c : bytes) text += fmt::format("{:02x}", c);
    return text;
  };
  std::string counted, half;
  for (int i = 0; i < 32; ++i) counted += static_cast<char>(i);
  for (int i = 0; i < 32; ++i) half += static_cast<char>(i % 16 * 37 + i % 16 * i % 16);
  for (const std::string& text : {std::string(64, '0'), std::string(64, 'f'), pattern, simulation,
                                  hex(counted), hex(half), hex("correct horse battery staple 123")}) {
    std::ofstream(path) << text;
    chmod(path.c_str(), 0600);
    EXPECT_THAT(ErrorOfReading(), HasSubstr("expected a random key")) << text;
  }
}

TEST_F(KeyFileTest, TheNextKeyLiesBesideTheKeyAndReplacesIt) {
  WriteNewKeyFile(path);
  const auto first = ReadKeyFile(path);
  EXPECT_EQ(ReadNextKeyFile(path, first), std::nullopt);
  WriteNextKeyFile(path);
  struct stat info {};
  ASSERT_EQ(stat((path + ".next").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0600U);
  const auto next = ReadNextKeyFile(path, first);
  ASSERT_TRUE(next);
  EXPECT_NE(*next, first);
  EXPECT_EQ(ReadKeyFile(path), first) << "unchanged so far";
  FinishKeyChange(path);
  EXPECT_EQ(ReadKeyFile(path), *next);
  EXPECT_FALSE(std::filesystem::exists(path + ".next"));
}

TEST_F(KeyFileTest, OfAKeyBehindASymbolicLinkTheFileIsReplaced) {
  const std::string kept = path + ".kept";
  WriteNewKeyFile(kept);
  const auto old = ReadKeyFile(kept);
  std::filesystem::create_symlink(kept, path);
  WriteNextKeyFile(path);
  const auto next = ReadKeyFile(NextKeyFile(path));
  FinishKeyChange(path);
  EXPECT_TRUE(std::filesystem::is_symlink(path));
  EXPECT_EQ(ReadKeyFile(kept), next);
  EXPECT_NE(ReadKeyFile(kept), old);
  EXPECT_FALSE(std::filesystem::exists(NextKeyFile(path)));
}

TEST_F(KeyFileTest, ANextKeyThatIsThereIsKept) {
  WriteNewKeyFile(path);
  WriteNextKeyFile(path);
  const auto next = ReadNextKeyFile(path, {});
  EXPECT_THROW(WriteNextKeyFile(path), std::runtime_error);
  EXPECT_EQ(ReadNextKeyFile(path, {}), next);
}

TEST_F(KeyFileTest, ANextKeyThatRootMakesBelongsToTheOwnerOfTheKey) {
  if (geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  WriteNewKeyFile(path);
  ASSERT_EQ(chown(path.c_str(), 1234, 1234), 0);
  WriteNextKeyFile(path);
  struct stat info {};
  ASSERT_EQ(stat((path + ".next").c_str(), &info), 0);
  EXPECT_EQ(info.st_uid, 1234U);
  EXPECT_EQ(info.st_mode & 0777U, 0600U);
}

TEST_F(KeyFileTest, ANextKeyNeedsAKey) {
  EXPECT_THROW(WriteNextKeyFile(path), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(path + ".next"));
}

TEST_F(KeyFileTest, ANextKeyThatOthersCanReadOrThatIsTheSameIsRefused) {
  WriteNewKeyFile(path);
  std::filesystem::copy_file(path, path + ".next");
  EXPECT_THROW(ReadNextKeyFile(path, ReadKeyFile(path)), std::runtime_error);
  EXPECT_THROW(FinishKeyChange(path), std::runtime_error);
  std::filesystem::remove(path + ".next");
  WriteNextKeyFile(path);
  ASSERT_EQ(chmod((path + ".next").c_str(), 0640), 0);
  EXPECT_THROW(ReadNextKeyFile(path, ReadKeyFile(path)), std::runtime_error);
  EXPECT_THROW(FinishKeyChange(path), std::runtime_error);
  EXPECT_TRUE(std::filesystem::exists(path + ".next"));
}

TEST_F(KeyFileTest, WithoutANextKeyNothingIsFinished) {
  WriteNewKeyFile(path);
  const auto key = ReadKeyFile(path);
  EXPECT_THROW(FinishKeyChange(path), std::runtime_error);
  EXPECT_EQ(ReadKeyFile(path), key);
}

TEST_F(KeyFileTest, AKeyAppearsWholeOrNotAtAll) {
  // What a process left behind that was ended in the middle.
  std::ofstream(path + ".part") << "half";
  WriteNewKeyFile(path);
  EXPECT_NO_THROW(ReadKeyFile(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  const std::string nowhere = (folder / "none" / "link.key").string();
  EXPECT_THROW(WriteNewKeyFile(nowhere), std::runtime_error);
}

}  // namespace
}  // namespace priamos::radio
