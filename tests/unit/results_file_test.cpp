// SPDX-License-Identifier: Apache-2.0
// results.h5 as our reader and as h5py see it, and results.xdmf.
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
  ResultsFile file(&results, {"sample", "nscdd", "0.1.0", 2, 3, 8.0, -1.0}, SampleShapes());
  file.Save({1, 0.25, 1.0}, SampleGrains(), {});
  file.Save({50, 12.5, 1.0}, SampleGrains(), SampleContacts());
  file.Close();
  results.Finish();
}

/// The same in three segments, the last of which is written twice, as after a kill.
void WriteInSegments(const fs::path& folder) {
  const RunDescription run{"sample", "nscdd", "0.1.0", 2, 3, 8.0, -1.0};
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
  ResultsFile file(&results, run, kept);
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

TEST(ResultsFile, H5pyReadsItAndXdmfNamesWhatIsThere) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2> /dev/null") != 0) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  WriteSample(folder.path());
  std::ofstream(folder.path() / "check.py") << R"(
import h5py, os, sys
import xml.etree.ElementTree as xml
os.chdir(sys.argv[1])
f = h5py.File("results.h5", "r")
assert f.attrs["scene"] == "sample" and f.attrs["format_version"] == 1 and f.attrs["period"] == 8.0
assert list(f["steps"]) == ["000001", "000050"]
step = f["steps/000050"]
assert step.attrs["time"] == 12.5 and step.attrs["step"] == 50
assert sorted(step["grains/id"][:]) == [7, 9, 30, 40]
assert step["grains/x"].attrs["unit"] == "m" and step["contacts/impulse_n"].attrs["unit"] == "N s"
assert list(step["contacts/impulse_n"][:]) == [2.0, 0.0, 1.0]
assert list(f["shapes/kind"][:]) == [0, 1]
items = 0
for item in xml.parse("results.xdmf").iter("DataItem"):
    name, path = item.text.split(":")
    data = h5py.File(name, "r")[path]
    assert data.shape == (int(item.get("Dimensions")),), path
    assert data.dtype.itemsize == int(item.get("Precision")), path
    assert {"f": "Float", "i": "Int", "u": "UChar"}[data.dtype.kind] == item.get("NumberType"), path
    items += 1
assert items == 2 * (2 + 11) + (2 + 17), items
times = [t.get("Value") for t in xml.parse("results.xdmf").iter("Time")]
assert times == ["0.25", "12.5", "12.5"], times
)";
  const std::string command =
      "/usr/bin/python3 '" + (folder.path() / "check.py").string() + "' '" + folder.path().string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace nscdd
