// SPDX-License-Identifier: Apache-2.0
// Whose results a folder holds, and that nothing is half-written.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "results/written_file.h"
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

TEST(ResultsFolder, CheckpointsOfAnUnfinishedRunAreNotLost) {
  const TemporaryFolder folder;
  {
    ResultsFolder results(folder.path(), IdentityOf("drum"), RankGroup());
    for (const char* name : {"checkpoint_000000.ckpt", "checkpoint_000020.ckpt", "results_000000.h5.part"}) {
      std::ofstream(folder.path() / name) << "x";
    }
    results.KeepParts();
  }
  const std::string sentence = SentenceOf([&] { ResultsFolder(folder.path(), IdentityOf("drum"), RankGroup()); });
  EXPECT_NE(sentence.find("checkpoint after step 20"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("--resume"), std::string::npos) << sentence;
  EXPECT_TRUE(fs::exists(folder.path() / "checkpoint_000020.ckpt"));
  {
    ResultsFolder results(folder.path(), RankGroup());  // goes on
    EXPECT_NE(SentenceOf([&] { ResultsFolder(folder.path(), RankGroup()); }).find("another run is writing"), std::string::npos);
  }
  EXPECT_TRUE(fs::exists(folder.path() / "checkpoint_000020.ckpt"));  // it failed at once, and nothing is gone
  ResultsFolder results(folder.path(), RankGroup());
  results.Identify(IdentityOf("drum"));
  std::ofstream(results.Stage("steps.csv")) << "1";
  results.Finish();
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "steps.csv"}));
}

TEST(ResultsFolder, NothingToResumeIsASentence) {
  const TemporaryFolder folder;
  const auto sentence = [&](const fs::path& where) { return SentenceOf([&] { ResultsFolder(where, RankGroup()); }); };
  EXPECT_NE(sentence(folder.path() / "no").find("there is no folder"), std::string::npos);
  EXPECT_NE(sentence(folder.path()).find("holds no run"), std::string::npos);
  {
    ResultsFolder results(folder.path(), IdentityOf("drum"), RankGroup());
    results.KeepParts();
  }
  EXPECT_NE(sentence(folder.path()).find("has no checkpoint"), std::string::npos);
  RunScene(folder.path(), "drum", "steps.csv", "1");
  EXPECT_NE(sentence(folder.path()).find("has finished (3 steps)"), std::string::npos) << sentence(folder.path());
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"run.json", "steps.csv"}));
}

// Whenever it happens, a run that has ended is found complete.
TEST(ResultsFolder, AKillAmongTheRenamesIsMadeGood) {
  const TemporaryFolder folder;
  RunScene(folder.path(), "drum", "tradeoff.csv", "of an earlier run");
  std::string marker;
  {
    const fs::path other = folder.path() / "other";
    ResultsFolder results(other, IdentityOf("drum"), RankGroup());
    for (const char* name : {"final.csv", "steps.csv"}) std::ofstream(results.Stage(name)) << "new";
    results.Finish();
    marker = TextOf(other / "run.json");
    fs::remove_all(other);
  }
  std::ofstream(folder.path() / "run.json.finished") << marker;
  std::ofstream(folder.path() / "run.json.part") << "";
  std::ofstream(folder.path() / "final.csv") << "new";  // has its name already
  std::ofstream(folder.path() / "steps.csv.part") << "new";
  std::ofstream(folder.path() / "checkpoint_000020.ckpt") << "x";
  const std::string sentence = SentenceOf([&] { ResultsFolder(folder.path(), RankGroup()); });
  EXPECT_NE(sentence.find("has finished"), std::string::npos) << sentence;
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"final.csv", "run.json", "steps.csv"}));
  EXPECT_EQ(TextOf(folder.path() / "steps.csv"), "new");
  EXPECT_EQ(TextOf(folder.path() / "run.json"), marker);
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
