// SPDX-License-Identifier: Apache-2.0
// A file is replaced at once and whole.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "nscdd/error.h"
#include "results/written_file.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

std::string Content(std::istream& in) { return {std::istreambuf_iterator<char>(in), {}}; }
std::string ContentOf(const fs::path& file) {
  std::ifstream in(file);
  return Content(in);
}

class ReplacedFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();  // tests run at the same time
    folder_ = fs::path(testing::TempDir()) / (std::string("replaced_") + test->name() + "_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "file.txt";
    ReplaceText(file_, "old");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_, file_;
};

TEST_F(ReplacedFileTest, WhoReadsTheOldFileGoesOnReadingIt) {
  std::ifstream reader(file_);
  ReplaceText(file_, "new");
  EXPECT_EQ(Content(reader), "old");
  EXPECT_EQ(ContentOf(file_), "new");
}

TEST_F(ReplacedFileTest, WithoutCommitNothingHasHappened) {
  {
    const ReplacedFile replaced(file_);
    std::ofstream(replaced.part()) << "half";
    EXPECT_EQ(ContentOf(file_), "old");
  }
  EXPECT_EQ(ContentOf(file_), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(ReplacedFileTest, ALinkStaysALink) {
  fs::create_symlink("file.txt", folder_ / "link");
  ReplaceText(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(ContentOf(file_), "new");
}

TEST_F(ReplacedFileTest, ADeviceIsWrittenAsItIs) {
  ReplaceText("/dev/null", "new");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(ReplacedFileTest, RefusalsNameTheFile) {
  try {
    ReplaceText(folder_ / "nowhere" / "file.txt", "new");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("nowhere/file.txt: "), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace nscdd
