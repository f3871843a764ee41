// SPDX-License-Identifier: Apache-2.0
// results.h5 as our reader and as h5py see it; results.xdmf: tests/paraview.
#include <gtest/gtest.h>
#include <mpi.h>

#include <cstdlib>

#include "results/results_file.h"
#include "results/results_reader.h"
#include "results_sample.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

void WriteSample(const fs::path& folder) {
  ResultsFolder results(folder, IdentityOf("sample"), RankGroup());
  ResultsFile file(&results, {"sample", "nscdd", "0.1.0", 2, 3, 8.0, -1.0, 0.25}, SampleShapes());
  file.Save({1, 0.25, 1.0}, SampleGrains(), {});
  file.Save({50, 12.5, 1.0}, SampleGrains(), SampleContacts());
  file.Close();
  results.Finish();
}

/// The same in three segments, the last of which is written twice, as after a kill.
void WriteInSegments(const fs::path& folder) {
  const RunDescription run{"sample", "nscdd", "0.1.0", 2, 3, 8.0, -1.0, 0.25};
  ResultsFolder results(folder, IdentityOf("sample"), RankGroup());
  std::vector<FileExtent> kept;
  {
    ResultsFile file(&results, run, SampleShapes(), ResultsFile::Mode::kSegments);
    file.Keep();
    file.Save({1, 0.25, 1.0}, SampleGrains(), {});
    kept = file.Keep();
    EXPECT_EQ(file.Keep().size(), 2u);  // nothing came in between
    file.Save({50, 99.0, 1.0}, {}, {});
  }
  EXPECT_EQ(kept.size(), 2u);
  for (const FileExtent& extent : kept) EXPECT_NO_THROW(CheckExtent(folder, extent));
  ResultsFile file(&results, run, SampleShapes(), kept);
  file.Save({50, 12.5, 1.0}, SampleGrains(), SampleContacts());
  file.Close();
  results.Finish();
}

TEST(ResultsFile, OfSegmentsIsTheSame) {
  const TemporaryFolder folder;
  WriteSample(folder.path() / "whole");
  WriteInSegments(folder.path() / "segments");
  EXPECT_EQ(TextOf(folder.path() / "segments/results.xdmf"), TextOf(folder.path() / "whole/results.xdmf"));
  const ResultsReader whole(folder.path() / "whole"), segments(folder.path() / "segments");
  EXPECT_EQ(segments.steps(), whole.steps());
  EXPECT_EQ(segments.run().period_origin, whole.run().period_origin);
  EXPECT_EQ(segments.ReadShapes().x1, whole.ReadShapes().x1);
  EXPECT_EQ(segments.ReadStep(50).time, 12.5);
  EXPECT_EQ(segments.ReadGrains(50).x, whole.ReadGrains(50).x);
  EXPECT_EQ(segments.ReadContacts(50).impulse_n, whole.ReadContacts(50).impulse_n);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "segments"), {}), 3);  // no segment is left
}

TEST(ResultsFile, IsReadBack) {
  const TemporaryFolder folder;
  WriteSample(folder.path());
  const ResultsReader reader(folder.path());
  EXPECT_EQ(reader.run().scene, "sample");
  EXPECT_EQ(reader.run().solver, "nscdd");
  EXPECT_EQ(reader.run().subdomains_x, 2);
  EXPECT_EQ(reader.run().subdomains_y, 3);
  EXPECT_EQ(reader.run().period, 8.0);
  EXPECT_EQ(reader.run().period_origin, -1.0);
  EXPECT_EQ(reader.run().dt, 0.25);
  EXPECT_EQ(reader.steps(), (std::vector<std::int64_t>{1, 50}));
  EXPECT_EQ(reader.ReadStep(50).time, 12.5);
  EXPECT_EQ(reader.ReadStep(50).mean_radius, 1.0);

  const GrainTable grains = reader.ReadGrains(50);
  EXPECT_EQ(grains.id, (std::vector<std::int64_t>{7, 9, 30, 40}));
  EXPECT_EQ(grains.x, (std::vector<double>{1.0, 3.0, 5.0, 3.0}));
  EXPECT_EQ(grains.vx, (std::vector<double>{1.0 / 3.0, -2.0, 0.0, 0.0}));
  EXPECT_EQ(grains.multiplicity, (std::vector<std::int32_t>{2, 3, 1, 0}));
  EXPECT_EQ(grains.kind, (std::vector<std::uint8_t>{0, 0, 0, 1}));

  const ContactRows contacts = reader.ReadContacts(50), expected = SampleContacts();
  EXPECT_EQ(contacts.body_b, expected.body_b);
  EXPECT_EQ(contacts.shape_b, expected.shape_b);
  EXPECT_EQ(contacts.final_gap, expected.final_gap);
  EXPECT_EQ(contacts.impulse_n, expected.impulse_n);
  EXPECT_EQ(contacts.point_x, expected.point_x);
  EXPECT_EQ(contacts.force_y, expected.force_y);
  EXPECT_EQ(contacts.velocity_t, expected.velocity_t);
  EXPECT_EQ(contacts.status, expected.status);
  EXPECT_EQ(reader.ReadContacts(1).size(), 0u);

  const ShapeTable shapes = reader.ReadShapes();
  EXPECT_EQ(shapes.body, SampleShapes().body);
  EXPECT_EQ(shapes.kind, SampleShapes().kind);
  EXPECT_EQ(shapes.x1, SampleShapes().x1);
}

TEST(ResultsFile, NeedsNoMpi) {
  const TemporaryFolder folder;
  WriteSample(folder.path());
  int initialised = 1;
  MPI_Initialized(&initialised);
  EXPECT_EQ(initialised, 0);
}

TEST(ResultsFile, MissingFileOrStepIsASentence) {
  const TemporaryFolder folder;
  EXPECT_NE(SentenceOf([&] { ResultsReader reader(folder.path()); }).find("there is no"), std::string::npos);
  WriteSample(folder.path());
  const ResultsReader reader(folder.path());
  const std::string sentence = SentenceOf([&] { reader.ReadGrains(2); });
  EXPECT_NE(sentence.find("step 2"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("1, 50"), std::string::npos) << sentence;
}

TEST(ResultsFile, ForeignFileIsASentence) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "results.h5") << "not HDF5";
  const std::string sentence = SentenceOf([&] { ResultsReader reader(folder.path()); });
  EXPECT_NE(sentence.find((folder.path() / "results.h5").string()), std::string::npos) << sentence;
}

TEST(ResultsFile, XdmfHasTheSameBlocksAtEachTime) {
  const TemporaryFolder folder;
  WriteSample(folder.path());
  const std::string text = TextOf(folder.path() / "results.xdmf");
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("CollectionType=\"Temporal\""), 4u);
  EXPECT_EQ(count("<Time Value=\"0.25\"/>"), 4u);
  EXPECT_EQ(count("<Time Value=\"12.5\"/>"), 4u);
  EXPECT_EQ(count("/steps/000001/disks/position"), 1u);  // a body of several shapes is there
  EXPECT_EQ(count("NumberOfElements=\"0\""), 2u);        // no contacts at the first
}

TEST(ResultsFile, H5pyReadsIt) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2> /dev/null") != 0) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  WriteSample(folder.path());
  std::ofstream(folder.path() / "check.py") << R"(
import h5py, os, sys
import xml.etree.ElementTree as xml
os.chdir(sys.argv[1])
f = h5py.File("results.h5", "r")
assert f.attrs["scene"] == "sample" and f.attrs["format_version"] == 2 and f.attrs["dt"] == 0.25 and f.attrs["period"] == 8.0
assert list(f["steps"]) == ["000001", "000050"]
step = f["steps/000050"]
assert step.attrs["time"] == 12.5 and step.attrs["step"] == 50
assert sorted(step["grains/id"][:]) == [7, 9, 30, 40]
assert step["grains/position"].attrs["unit"] == "m" and step["grains/position"].shape == (4, 3)
assert step["contacts/impulse_n"].attrs["unit"] == "N s"
assert list(step["contacts/impulse_n"][:]) == [2.0, 0.0, 1.0]
assert list(f["shapes/kind"][:]) == [0, 1]
assert list(step["contacts/force"][2]) == [0.8, -4.0, 0.0]
)";
  const std::string command =
      "/usr/bin/python3 '" + (folder.path() / "check.py").string() + "' '" + folder.path().string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace nscdd
