// Whose results a folder holds, and that nothing is half-written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "results/staged_file.h"
#include "results_sample.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

std::set<std::string> NamesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

void RunScene(const fs::path& folder, const std::string& scene, const std::string& name, const std::string& text) {
  ResultsFolder results(folder, IdentityOf(scene), RankGroup());
  StagedFile file(results.Stage(name));
  file.Write(text);
  file.Close();
  results.Finish();
}

TEST(ResultsFolder, FilesGetTheirNamesAtTheEnd) {
  const TemporaryFolder base;
  const fs::path folder = base.path() / "results" / "two_disks";
  ResultsFolder results(folder, IdentityOf("two_disks"), RankGroup());
  StagedFile file(results.Stage("steps.csv"));
  file.Write("1\n");
  EXPECT_EQ(NamesIn(folder), (std::set<std::string>{"run.json.part", "steps.csv.part"}));
  EXPECT_EQ(TextOf(folder / "steps.csv.part"), "1\n");  // may be watched meanwhile
  file.Close();
  results.Finish();
  EXPECT_EQ(NamesIn(folder), (std::set<std::string>{"run.json", "steps.csv"}));
  const auto marker = nlohmann::json::parse(TextOf(folder / "run.json"));
  EXPECT_EQ(marker["scene"], "two_disks");
  EXPECT_EQ(marker["settings"]["steps"], "3");
  EXPECT_EQ(marker["files"], nlohmann::json({"steps.csv"}));
}

TEST(ResultsFolder, SameSceneReplacesAndLeavesNothingStale) {
  const TemporaryFolder folder;
  RunScene(folder.path(), "drum", "results.h5", "old");
  RunScene(folder.path(), "drum", "tradeoff.csv", "old");
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "tradeoff.csv"}));
  RunScene(folder.path(), "drum", "steps.csv", "new");
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "steps.csv"}));
  EXPECT_EQ(TextOf(folder.path() / "steps.csv"), "new");
}

TEST(ResultsFolder, RefusesResultsOfAnotherScene) {
  const TemporaryFolder folder;
  RunScene(folder.path(), "drum", "steps.csv", "of the drum");
  const std::string sentence = SentenceOf([&] { ResultsFolder(folder.path(), IdentityOf("column"), RankGroup()); });
  EXPECT_NE(sentence.find(folder.path().string()), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("'drum'"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("--out"), std::string::npos) << sentence;
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "steps.csv"}));
  EXPECT_EQ(TextOf(folder.path() / "steps.csv"), "of the drum");
}

TEST(ResultsFolder, RefusesFilesOfUnknownOrigin) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "final.csv") << "mine";
  const std::string sentence = SentenceOf([&] { ResultsFolder(folder.path(), IdentityOf("column"), RankGroup()); });
  EXPECT_NE(sentence.find("final.csv"), std::string::npos) << sentence;
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"final.csv"}));
}

TEST(ResultsFolder, OtherFilesAreLeftAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "notes.txt") << "mine";
  RunScene(folder.path(), "column", "steps.csv", "1");
  EXPECT_EQ(TextOf(folder.path() / "notes.txt"), "mine");
}

TEST(ResultsFolder, AMarkerCannotNameFilesElsewhere) {
  const TemporaryFolder base;
  const fs::path folder = base.path() / "inner";
  std::ofstream(base.path() / "precious") << "mine";
  RunScene(folder, "column", "steps.csv", "1");
  std::ofstream(folder / "run.json") << R"({"format": "nscdd run 1", "scene": "column", "files": ["../precious"]})";
  RunScene(folder, "column", "steps.csv", "2");
  EXPECT_TRUE(fs::exists(base.path() / "precious"));
}

TEST(ResultsFolder, FolderIsAFile) {
  const TemporaryFolder base;
  std::ofstream(base.path() / "file") << "x";
  const std::string sentence = SentenceOf([&] { ResultsFolder(base.path() / "file", IdentityOf("a"), RankGroup()); });
  EXPECT_NE(sentence.find("is a file, not a folder"), std::string::npos) << sentence;
  EXPECT_NE(SentenceOf([&] { ResultsFolder(base.path() / "file" / "below", IdentityOf("a"), RankGroup()); }), "");
}

TEST(ResultsFolder, UnwritableFolderIsNamed) {
  const std::string sentence = SentenceOf([] { ResultsFolder("/proc/nscdd_results", IdentityOf("a"), RankGroup()); });
  EXPECT_NE(sentence.find("cannot write /proc/nscdd_results"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("--out"), std::string::npos) << sentence;
}

TEST(ResultsFolder, AnErrorBeforeTheFirstStepLeavesNothing) {
  const TemporaryFolder base;
  const fs::path folder = base.path() / "results" / "two_disks";
  {
    ResultsFolder results(folder, IdentityOf("two_disks"), RankGroup());
    StagedFile file(results.Stage("steps.csv"));
    file.Write("half");
  }
  EXPECT_FALSE(fs::exists(base.path() / "results"));
}

TEST(ResultsFolder, AnErrorLaterLeavesThePartsAndTheOldResults) {
  const TemporaryFolder folder;
  RunScene(folder.path(), "drum", "steps.csv", "old");
  {
    ResultsFolder results(folder.path(), IdentityOf("drum"), RankGroup());
    StagedFile file(results.Stage("steps.csv"));
    file.Write("half");
    results.KeepParts();
  }
  EXPECT_EQ(TextOf(folder.path() / "steps.csv"), "old");
  EXPECT_EQ(TextOf(folder.path() / "steps.csv.part"), "half");
  // The next run of the same scene takes over, one of another scene does not.
  EXPECT_NE(SentenceOf([&] { ResultsFolder(folder.path(), IdentityOf("column"), RankGroup()); }), "");
  RunScene(folder.path(), "drum", "steps.csv", "new");
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "steps.csv"}));
}

TEST(ResultsFolder, TwoRunsAtATimeAreRefused) {
  const TemporaryFolder folder;
  ResultsFolder first(folder.path(), IdentityOf("drum"), RankGroup());
  std::ofstream(first.Stage("steps.csv")) << "of the first";
  const std::string sentence = SentenceOf([&] { ResultsFolder(folder.path(), IdentityOf("drum"), RankGroup()); });
  EXPECT_NE(sentence.find("another run is writing"), std::string::npos) << sentence;
  first.Finish();
  EXPECT_EQ(TextOf(folder.path() / "steps.csv"), "of the first");
}

TEST(ResultsFolder, HashSeesEveryByte) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "a";
  EXPECT_EQ(HashOfFile(folder.path() / "a"), "af63dc4c8601ec8c");  // published value of 64-bit FNV-1a
  EXPECT_NE(SentenceOf([&] { HashOfFile(folder.path() / "b"); }), "");
}

TEST(StagedFile, AFullDiskIsASentence) {
  StagedFile file("/dev/full");
  const std::string sentence = SentenceOf([&] { file.Write("x"); });
  EXPECT_NE(sentence.find("/dev/full"), std::string::npos);
  EXPECT_NE(sentence.find("free some space"), std::string::npos);
}

}  // namespace
}  // namespace nscdd
