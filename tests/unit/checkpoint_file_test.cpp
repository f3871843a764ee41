// SPDX-License-Identifier: Apache-2.0
// Checkpoint files: what is written is read, and nothing else is.
#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "checkpoint/checkpoint.h"
#include "checkpoint/resume_point.h"
#include "results/crc64.h"
#include "results/run_files.h"
#include "results_sample.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> Bytes(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

CheckpointHead SampleHead(std::int64_t step) {
  CheckpointHead head;
  head.run.program = "0.1.0";
  head.run.scene_text = "[time]\ndt = 0.1 # \xC3\xA9\n";
  head.run.inputs = {{"/a.csv", "77"}};
  head.run.options = {{"theta", "0.5"}, {"subdomains", "2x3"}};
  head.run.steps = 100;
  head.run.checkpoint_every = 20;
  head.step = step;
  head.tables = {{"steps.csv.part", 3, 0xFFFFFFFFFFFFFFFF}};
  head.segments = {{"results_000000.h5.part", 1, 2}};
  return head;
}

/// Not numbers to be printed: to be kept bit for bit.
std::vector<SavedBody> SampleBodies() {
  return {{7, {0.1, -0.0, 1e-310}, {1.0 / 3.0, -2.5, 0.0}}, {std::int64_t{1} << 40, {5.0, 6.0, 7.0}, {8.0, 9.0, 10.0}}};
}

std::vector<std::byte> SampleFile() {
  const TemporaryFolder folder;
  WriteCheckpoint(folder.path(), SampleHead(40), SampleBodies(), Bytes("solver"), RankGroup());
  return Bytes(TextOf(folder.path() / "checkpoint_000040.ckpt"));
}

TEST(Crc64, IsThatOfXz) {
  Crc64 crc;
  crc.Add(Bytes("12345"));
  crc.Add(Bytes("6789"));
  EXPECT_EQ(crc.value(), 0x995DC9BBDF1939FA);  // the published check value
  Crc64 in_pieces, at_once;
  const std::string text(1000, 'x');
  for (std::size_t i = 0; i < text.size(); i += 7) in_pieces.Add(Bytes(text.substr(i, 7)));
  at_once.Add(Bytes(text));
  EXPECT_EQ(in_pieces.value(), at_once.value());
}

TEST(Checkpoint, IsReadBackBitForBit) {
  const std::vector<std::byte> file = SampleFile();
  const Checkpoint read = ParseCheckpoint(file);
  EXPECT_EQ(FormatHead(read.head), FormatHead(SampleHead(40)));
  EXPECT_EQ(read.head.run.scene_text, SampleHead(40).run.scene_text);
  EXPECT_EQ(read.head.tables[0].crc, 0xFFFFFFFFFFFFFFFF);
  ASSERT_EQ(read.sections.size(), 1u);
  ASSERT_EQ(read.sections[0].body_count(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const SavedBody body = read.sections[0].body(i), expected = SampleBodies()[i];
    EXPECT_EQ(std::memcmp(&body, &expected, sizeof body), 0);
  }
  EXPECT_EQ(std::vector<std::byte>(read.sections[0].state.begin(), read.sections[0].state.end()), Bytes("solver"));
}

TEST(Checkpoint, EveryFlippedBitIsRefused) {
  std::vector<std::byte> file = SampleFile();
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      file[i] ^= std::byte{1} << bit;
      EXPECT_NE(SentenceOf([&] { ParseCheckpoint(file); }), "") << "bit " << bit << " of byte " << i;
      file[i] ^= std::byte{1} << bit;
    }
  }
  EXPECT_NO_THROW(ParseCheckpoint(file));
}

TEST(Checkpoint, EveryLengthButItsOwnIsRefused) {
  std::vector<std::byte> file = SampleFile();
  for (std::size_t size = 0; size < file.size(); ++size) {
    EXPECT_NE(SentenceOf([&] { ParseCheckpoint(std::span(file).first(size)); }), "") << size;
  }
  file.push_back(std::byte{0});
  EXPECT_NE(SentenceOf([&] { ParseCheckpoint(file); }), "");
}

/// The same bytes with `size` of them at `place` replaced, and a checksum that fits: what a hostile hand could write.
std::vector<std::byte> Forged(std::vector<std::byte> file, std::size_t place, const void* value, std::size_t size) {
  std::memcpy(&file[place], value, size);
  Crc64 crc;
  crc.Add(std::span(file).first(file.size() - 8));
  const std::uint64_t sum = crc.value();
  std::memcpy(&file[file.size() - 8], &sum, 8);
  return file;
}

TEST(Checkpoint, AFittingChecksumDoesNotMakeItRight) {
  const std::vector<std::byte> file = SampleFile();
  std::uint64_t head_size = 0;
  std::memcpy(&head_size, &file[24], 8);
  const std::uint64_t huge[] = {head_size + 1, file.size(), ~std::uint64_t{0}, std::uint64_t{1} << 61,
                                (~std::uint64_t{0}) / 56 + 1};
  for (const std::uint64_t number : huge) {
    for (const std::size_t place :
         {std::size_t{24}, 32 + head_size, 40 + head_size}) {  // size of the head, bodies, size of the state
      EXPECT_NE(SentenceOf([&] { ParseCheckpoint(Forged(file, place, &number, 8)); }), "") << number << " at " << place;
    }
  }
  EXPECT_NE(SentenceOf([&] { ParseCheckpoint(Forged(file, 32, "[", 1)); }).find("description"), std::string::npos);
  const std::uint32_t version = 2;
  EXPECT_NE(SentenceOf([&] { ParseCheckpoint(Forged(file, 8, &version, 4)); }).find("format version 2"), std::string::npos);
}

TEST(Checkpoint, HeadsThatAreNone) {
  std::string text = FormatHead(SampleHead(40));
  for (const char* bad : {"", "null", "[]", "{}", R"({"step": -1})"}) EXPECT_NE(SentenceOf([&] { ParseHead(bad); }), "") << bad;
  std::string float_text = text;
  float_text.replace(text.find("\"step\":40"), 9, "\"step\":4e99");
  EXPECT_NE(SentenceOf([&] { ParseHead(float_text); }).find("no integer"), std::string::npos);
  EXPECT_NE(SentenceOf([&] { ParseHead(text.replace(text.find("\"step\":40"), 9, "\"step\":-4")); }), "");
}

std::set<std::string> NamesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// Writes a checkpoint that names the files that are there.
void Write(const fs::path& folder, std::int64_t step) {
  CheckpointHead head = SampleHead(step);
  head.tables = {ExtentOf(folder, "steps.csv.part")};
  head.segments.clear();
  WriteCheckpoint(folder, head, SampleBodies(), Bytes("solver"), RankGroup());
}

void Append(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::app | std::ios::binary) << text; }

TEST(Checkpoint, TheLastTwoStay) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  for (const std::int64_t step : {0, 20, 40, 1234567}) Write(folder.path(), step);
  EXPECT_EQ(NamesIn(folder.path()),
            (std::set<std::string>{"checkpoint_000040.ckpt", "checkpoint_1234567.ckpt", "steps.csv.part"}));
  EXPECT_EQ(CheckpointSteps(folder.path()), (std::vector<std::int64_t>{40, 1234567}));
}

TEST(Checkpoint, WhatCannotBeWrittenLeavesThePreviousOne) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  const std::string before = TextOf(folder.path() / "checkpoint_000020.ckpt");
  fs::create_symlink("/dev/full", folder.path() / "checkpoint_000040.ckpt.part");
  const std::string sentence = SentenceOf([&] { Write(folder.path(), 40); });
  EXPECT_NE(sentence.find("free some space"), std::string::npos) << sentence;
  EXPECT_EQ(NamesIn(folder.path()), (std::set<std::string>{"checkpoint_000020.ckpt", "steps.csv.part"}));
  EXPECT_EQ(TextOf(folder.path() / "checkpoint_000020.ckpt"), before);
}

TEST(ResumePoint, IsTheNewest) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  Append(folder.path() / "steps.csv.part", "more rows");
  Write(folder.path(), 40);
  Append(folder.path() / "steps.csv.part", "later");
  const ResumePoint point(folder.path(), RankGroup());
  EXPECT_EQ(point.head().step, 40);
  EXPECT_TRUE(point.warnings().empty());
}

TEST(ResumePoint, FallsBackWhenTheNewestIsDamaged) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  Write(folder.path(), 40);
  fs::resize_file(folder.path() / "checkpoint_000040.ckpt", 100);
  const ResumePoint point(folder.path(), RankGroup());
  EXPECT_EQ(point.head().step, 20);
  ASSERT_EQ(point.warnings().size(), 1u);
  EXPECT_NE(point.warnings()[0].find("checkpoint_000040.ckpt cannot be used: it has 100 bytes"), std::string::npos)
      << point.warnings()[0];
  EXPECT_EQ(NamesIn(folder.path()),
            (std::set<std::string>{"checkpoint_000020.ckpt", "checkpoint_000040.ckpt.damaged", "steps.csv.part"}));
}

TEST(ResumePoint, FallsBackWhenRowsAreMissing) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  Append(folder.path() / "steps.csv.part", "more");
  Write(folder.path(), 40);
  fs::resize_file(folder.path() / "steps.csv.part", 6);
  EXPECT_EQ(ResumePoint(folder.path(), RankGroup()).head().step, 20);
}

TEST(ResumePoint, NoneIsLeft) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  Write(folder.path(), 40);
  std::ofstream(folder.path() / "steps.csv.part") << "rOws";
  const std::string sentence = SentenceOf([&] { ResumePoint(folder.path(), RankGroup()); });
  EXPECT_NE(sentence.find("begin the run anew"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("checkpoint_000040.ckpt cannot be used"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("steps.csv.part is damaged"), std::string::npos) << sentence;
  EXPECT_EQ(CheckpointSteps(folder.path()).size(), 2u);  // the user may still find out why
}

TEST(ResumePoint, ACheckpointUnderAnotherNameIsRefused) {
  const TemporaryFolder folder;
  Append(folder.path() / "steps.csv.part", "rows");
  Write(folder.path(), 20);
  fs::copy(folder.path() / "checkpoint_000020.ckpt", folder.path() / "checkpoint_000030.ckpt");
  EXPECT_EQ(ResumePoint(folder.path(), RankGroup()).head().step, 20);
}

}  // namespace
}  // namespace nscdd
