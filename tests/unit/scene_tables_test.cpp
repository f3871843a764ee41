// SPDX-License-Identifier: Apache-2.0
// Tables of disks as other programs write them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/csv_cells.h"
#include "scene/disk_file.h"
#include "scene/free_ids.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

const std::string kTime = "[time]\ndt = 0.01\nsteps = 3\n";
const std::string kTable = kTime + "[[disks]]\nfile = \"d.csv\"\n";
const std::string kWall = "[[walls]]\ntype = \"half_plane\"\npoint = [0, 0]\n";

std::vector<BodyDefinition> Bodies(const Scene& scene, int rank = 0, int ranks = 1) {
  std::vector<BodyDefinition> bodies;
  ForEachBody(scene, rank, ranks, [&](const BodyDefinition& body) { bodies.push_back(body); });
  return bodies;
}

std::vector<std::int64_t> Ids(const Scene& scene, int ranks = 1) {
  std::vector<std::int64_t> ids;
  for (int rank = 0; rank < ranks; ++rank) {
    for (const BodyDefinition& body : Bodies(scene, rank, ranks)) ids.push_back(body.id);
  }
  return ids;
}

Scene SceneOf(const TestFolder& folder, const std::string& table, const std::string& scene = kTable) {
  folder.Write("d.csv", table);
  return ReadSceneFile(folder.Write("s.toml", scene));
}

/// What reading refuses with; empty if it accepts.
std::string Refusal(const std::string& table, const std::string& scene = kTable) {
  const TestFolder folder;
  try {
    SceneOf(folder, table, scene);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void ExpectIn(const std::string& fragment, const std::string& sentence) {
  EXPECT_NE(sentence.find(fragment), std::string::npos) << fragment << " in '" << sentence << "'";
}

TEST(CsvNumber, AsProgramsWriteThem) {
  const std::vector<std::pair<const char*, double>> good = {
      {"1.5", 1.5},         {"+1.5", 1.5},
      {"-1.5", -1.5},       {"1,5", 1.5},
      {"-0,25", -0.25},     {".5", 0.5},
      {"5.", 5.0},          {"+.5", 0.5},
      {"1e3", 1000.0},      {"1E+03", 1e3},
      {"1.0D+00", 1.0},     {"5.0D-01", 0.5},
      {"2d2", 200.0},       {"1,5e1", 15.0},
      {"1e-400", 0.0},      {"-1e-400", 0},
      {"4e-320", 4e-320},   {"0e999999", 0.0},
      {"0.0e-9999", 0.0},   {"1e-99999999999999999999", 0.0},
      {"1234.5e-999", 0.0}, {"1.7976931348623157e308", 1.7976931348623157e308},
      {"0.1", 0.1},         {"00012", 12.0}};
  for (const auto& [text, value] : good) {
    ASSERT_TRUE(CsvNumber(text).has_value()) << text;
    EXPECT_EQ(*CsvNumber(text), value) << text;
  }
  EXPECT_EQ(CsvNumber("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(CsvNumber(std::string(400, '9')), std::nullopt);
  EXPECT_EQ(CsvNumber("0." + std::string(400, '0') + "1e800"), std::nullopt) << "too large, in spite of its zeros";
  for (const char* text : {"",
                           "+",
                           "-",
                           ".",
                           ",",
                           "e5",
                           "nan",
                           "inf",
                           "-inf",
                           "infinity",
                           "1e999",
                           "-1e999",
                           "1e99999999999999999999",
                           "0x10",
                           "1e",
                           "--1",
                           "+-1",
                           "1.2.3",
                           "1,2,3",
                           "1.234,5",
                           "1,234.5",
                           ",5",
                           "5,",
                           "-,5",
                           "1 2",
                           "1.0-10",
                           "one"}) {
    EXPECT_EQ(CsvNumber(text), std::nullopt) << text;
  }
}

TEST(CsvNumber, Ids) {
  EXPECT_EQ(CsvId("7"), 7);
  EXPECT_EQ(CsvId("+7"), 7);
  EXPECT_EQ(CsvId("1.0e+00"), 1);
  EXPECT_EQ(CsvId("3.0"), 3);
  EXPECT_EQ(CsvId("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(CsvId("9007199254740992.0"), 9007199254740992);
  for (const char* text : {"", "-1", "-1.0", "1.5", "9223372036854775808", "1e30", "seven", "nan"}) {
    EXPECT_EQ(CsvId(text), std::nullopt) << text;
  }
}

TEST(CsvLine, Separators) {
  EXPECT_EQ(FindSeparator("x,y,radius"), Separator::kComma);
  EXPECT_EQ(FindSeparator("1, 2, 0.5"), Separator::kComma);
  EXPECT_EQ(FindSeparator("1 ,2 ,5"), Separator::kComma);
  EXPECT_EQ(FindSeparator("1,2,0.5"), Separator::kComma);
  EXPECT_EQ(FindSeparator("X (m), Y (m)"), Separator::kComma);
  EXPECT_EQ(FindSeparator("1,5;2;0,5"), Separator::kSemicolon);
  EXPECT_EQ(FindSeparator("1,5 2 0,5"), Separator::kBlank);
  EXPECT_EQ(FindSeparator("1,5\t2\t0,5"), Separator::kBlank);
  EXPECT_EQ(FindSeparator("1 2 0.5"), Separator::kBlank);
  EXPECT_EQ(FindSeparator("\"a;b\" \"c,d\""), Separator::kBlank);
}

TEST(CsvLine, Fields) {
  using Fields = std::vector<std::string_view>;
  Fields fields;
  EXPECT_TRUE(SplitLine(" \"1\", 2,,\"a,b\" \r", Separator::kComma, &fields));
  EXPECT_EQ(fields, (Fields{"1", "2", "", "a,b"}));
  EXPECT_TRUE(SplitLine("1\t \t2  3 ", Separator::kBlank, &fields));
  EXPECT_EQ(fields, (Fields{"1", "2", "3"}));
  EXPECT_FALSE(SplitLine("1,\"2,3", Separator::kComma, &fields));
}

struct Table {
  std::string name;
  std::string text;
  double x, y, radius;  ///< of the first disk
  std::size_t count = 1;
  std::string note = {};  ///< that is in the only note; empty: there is none
};
void PrintTo(const Table& table, std::ostream* out) { *out << table.name; }

class TableFromElsewhere : public testing::TestWithParam<Table> {};

TEST_P(TableFromElsewhere, IsRead) {
  const Table& table = GetParam();
  const TestFolder folder;
  const Scene scene = SceneOf(folder, table.text);
  const std::vector<BodyDefinition> bodies = Bodies(scene);
  ASSERT_EQ(bodies.size(), table.count);
  EXPECT_EQ(bodies[0].pose.x, table.x);
  EXPECT_EQ(bodies[0].pose.y, table.y);
  EXPECT_EQ(bodies[0].disks.at(0).radius, table.radius);
  ASSERT_EQ(scene.notes.sentences.size(), table.note.empty() ? 0u : 1u);
  if (!table.note.empty()) ExpectIn(table.note, scene.notes.sentences[0]);
}

INSTANTIATE_TEST_SUITE_P(
    All, TableFromElsewhere,
    testing::Values(
        Table{"blanks", "x y radius\n1 2 0.5\n", 1, 2, 0.5},
        Table{"aligned", "  x    y  radius\n 1.0  2.0     0.5\n", 1, 2, 0.5},
        Table{"tabs", "x\ty\tradius\n1\t2\t0.5\n", 1, 2, 0.5}, Table{"windows", "x,y,radius\r\n1,2,0.5\r\n", 1, 2, 0.5},
        Table{"byte_order_mark", "\xEF\xBB\xBFx,y,radius\n1,2,0.5\n", 1, 2, 0.5},
        Table{"byte_order_mark_and_numbers",
              "\xEF\xBB\xBF"
              "1 2 0.5\n",
              1, 2, 0.5, 1, "read as x, y, radius"},
        Table{"european", "x;y;radius\n1,5;2;0,5\n", 1.5, 2, 0.5}, Table{"semicolons", "x;y;radius\n1.5;2;0.5\n", 1.5, 2, 0.5},
        Table{"decimal_commas", "x y radius\n1,5 2 0,5\n", 1.5, 2, 0.5},
        Table{"decimal_commas_unnamed", "1,5\t2,25\t0,5\n", 1.5, 2.25, 0.5, 1, "read as x, y, radius"},
        Table{"quoted", "\"id\",\"x\",\"y\",\"radius\"\n\"1\",1,2,0.5\n", 1, 2, 0.5},
        Table{"quoted_commas", "\"x\",\"y\",\"radius\"\n\"1,5\",\"2\",\"0,5\"\n", 1.5, 2, 0.5},
        Table{"capitals", "X,Y,Radius\n1,2,1.0\n", 1, 2, 1}, Table{"diameter", "x,y,diameter\n1,2,1.0\n", 1, 2, 0.5},
        Table{"short_names", "X Y r\n1 2 0.5\n", 1, 2, 0.5}, Table{"d", "PosX,pos_y,D\n1,2,1\n", 1, 2, 0.5},
        Table{"paraview", "\"Points:0\",\"Points:1\",\"Points:2\",\"Radius\"\n1,2,0,0.5\n", 1, 2, 0.5, 1,
              "column Points:2 is not used"},
        Table{"dump_columns", "id,type,x,y,z,radius,mass\n1,1,1,2,0,0.5,0.785\n2,1,3,2,0,0.5,0.785\n", 1, 2, 0.5, 2,
              "d.csv: columns type, z, mass are not used."},
        Table{"text_column", "name,x,y,radius\na grain,1,2,0.5\n", 1, 2, 0.5, 1, "column name is not used"},
        Table{"index_column", ",x,y,radius\n0,1,2,0.5\n", 1, 2, 0.5},
        Table{"both_sizes", "x,y,radius,diameter\n1,2,0.5,7\n", 1, 2, 0.5, 1, "column diameter is not used"},
        Table{"own_name_first", "r,x,y,radius\n9,1,2,0.5\n", 1, 2, 0.5, 1, "column r is not used"},
        Table{"float_ids", "id,x,y,radius\n1.0e+00,1,2,0.5\n", 1, 2, 0.5},
        Table{"fortran", "x,y,radius\n1.0D+00,2.0D+00,5.0D-01\n", 1, 2, 0.5},
        Table{"signs", "x,y,radius\n+1.5,2,0.5\n1e-400,4,0.5\n", 1.5, 2, 0.5, 2},
        Table{"underflow", "x,y,radius\n1e-400,4,0.5\n", 0, 4, 0.5},
        Table{"numpy_header", "# x,y,radius\n1.0,2.0,0.5\n3.0,2.0,0.5\n", 1, 2, 0.5, 2},
        Table{"gnuplot_header", "# made by hand\n# radius x y\n\n0.5 1 2\n", 1, 2, 0.5},
        Table{"header_beats_comment", "# radius,x,y\nx,y,radius\n1,2,0.5\n", 1, 2, 0.5},
        Table{"unnamed", "1,2,0.5\n", 1, 2, 0.5, 1, "d.csv: names no columns; they were read as x, y, radius."},
        Table{"yade", "#geometry\n-1.69\t3.88\t4.0\t1.15\n-1.69\t0.88\t4.0\t0.55\n", -1.69, 3.88, 1.15, 2,
              "read as x, y, z, radius"},
        Table{"yade_format", "#format x_y_z_r_matId\n1\t2\t0\t0.5\t3\n", 1, 2, 0.5, 1, "columns z, matId are not used"}),
    [](const auto& test) { return test.param.name; });

struct BadTable {
  std::string name;
  std::string text;
  std::vector<std::string> fragments;
};
void PrintTo(const BadTable& table, std::ostream* out) { *out << table.name; }

class BadTableFromElsewhere : public testing::TestWithParam<BadTable> {};

TEST_P(BadTableFromElsewhere, IsRefusedWithTheMend) {
  const std::string sentence = Refusal(GetParam().text);
  for (const std::string& fragment : GetParam().fragments) ExpectIn(fragment, sentence);
  EXPECT_TRUE(sentence.ends_with(".") || sentence.ends_with("?")) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadTableFromElsewhere,
    testing::Values(
        BadTable{"no_radius_column", "x,y,mass\n1,2,3\n", {"d.csv:1:", "'radius' is missing", "such as x,y,radius"}},
        BadTable{"two_synonyms", "x,y,r,rad\n1,2,1,1\n", {"d.csv:1:", "'rad' is there twice, also as 'r'"}},
        BadTable{"capital_twice", "x,y,X,radius\n1,2,1,1\n", {"'X' is there twice, also as 'x'"}},
        BadTable{"zero_radius", "x,y,radius\n1,2,0\n", {"d.csv:2:", "radius 0 is not positive"}},
        BadTable{"radius_underflows", "x,y,radius\n1,2,1e-400\n", {"d.csv:2:", "radius 1e-400 is not positive"}},
        BadTable{"zero_diameter", "x,y,d\n1,2,0.0\n", {"d.csv:2:", "diameter 0.0 is not positive"}},
        BadTable{"spheres", "x,y,z,r\n1,2,0,1\n1,2,3,1\n", {"s.toml:5: key 'disks[1].file'", "z goes from 0 to 3 m", "layer"}},
        BadTable{"spheres_of_yade", "#geometry\n-1.69 3.88 3.5 1.15\n-1.69 0.88 4.0 0.55\n", {"z goes from 3.5 to 4 m"}},
        BadTable{"unnamed_commas", "1,5,2,1\n", {"d.csv:1:", "decimal marks", "x,y,z,radius"}},
        BadTable{"unnamed_many", "1 2 3 4 5 6\n", {"d.csv:1:", "6 numbers could be anything", "write the names"}},
        BadTable{"unnamed_few", "1 2\n", {"d.csv:1:", "2 numbers"}},
        BadTable{"decimal_commas_between_commas", "x,y,radius\n1,5,2,0,5\n", {"d.csv:2:", "5 fields", "decimal points"}},
        BadTable{"two_marks", "x;y;radius\n1,5;2;0.5\n", {"d.csv:2:", "decimal '.'", "before have ','"}},
        BadTable{"thousands", "x;y;radius\n1.234,5;2;0,5\n", {"d.csv:2:", "x '1.234,5' is not a finite number"}},
        BadTable{"comment_of_other_length", "# id x y radius mass\n1 2 0.5 7\n", {"d.csv:2:", "4 fields", "names 5 columns"}},
        BadTable{"open_quote", "x,y,radius\n1,\"2,0.5\n", {"d.csv:2:", "quote"}},
        BadTable{"row_names", "x y radius\n1 1 2 0.5\n", {"d.csv:2:", "4 fields where the header names 3 columns"}},
        BadTable{"row_too_short", "1 2 0.5\n1 2\n", {"d.csv:2:", "2 fields where the first row has 3 columns"}},
        BadTable{"lammps", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n", {"d.csv:1:", "LAMMPS", "ITEM: ATOMS"}},
        BadTable{"mercury", "2 0 0 0 1 1\n1 2 0 0 0.5 0 0 0\n", {"d.csv:1:", "6 numbers"}},
        BadTable{"lmgc90", "$bdyty\n RBDY2  1\n", {"d.csv:1:", "'x' is missing"}},
        BadTable{"kind", "x,y,radius,kind\n1,2,1,loose\n", {"d.csv:2:", "kind 'loose'"}},
        BadTable{"half_an_id", "id,x,y,radius\n1.5,1,2,1\n", {"d.csv:2:", "id '1.5'", "leave the column out"}},
        BadTable{"only_walls", "x,y,radius,kind\n1,2,1,wall\n", {"'disks[1].file'", "has no disk"}}),
    [](const auto& test) { return test.param.name; });

TEST(SceneTables, ASheetOfSpheresWithNoiseInZIsAPlane) {
  EXPECT_EQ(Refusal("x,y,z,r\n1,2,1e-9,1\n1,5,-1e-9,1\n"), "");
  ExpectIn("z goes from", Refusal("x,y,z,r\n1,2,0,1\n1,5,0.002,1\n"));
}

TEST(SceneTables, AFileMayLieOutsideTheScenesFolder) {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path() / "scenes");
  folder.Write("d.csv", "x,y,radius\n1,2,0.5\n");
  const auto table = [](const std::string& path) { return kTime + "[[disks]]\nfile = \"" + path + "\"\n"; };
  EXPECT_EQ(Bodies(ReadSceneFile(folder.Write("scenes/a.toml", table("../d.csv")))).size(), 1u);
  EXPECT_EQ(Bodies(ReadSceneFile(folder.Write("scenes/b.toml", table((folder.path() / "d.csv").string())))).size(), 1u);
}

TEST(SceneTables, KindsOfRowsAndRowsLeftOut) {
  const TestFolder folder;
  const Scene scene =
      SceneOf(folder,
              "id,x,y,radius,kind,vx\n0,0,0,0,wall,0\n5,1,2,0.5,free,3\n6,2,2,0.25,prescribed,4\n7,0,0,1,cluster,0\n"
              "8,9,9,1,0,0\n");
  ASSERT_EQ(scene.notes.sentences.size(), 1u);
  ExpectIn("2 walls or clusters are left out", scene.notes.sentences[0]);
  EXPECT_EQ(Ids(scene), (std::vector<std::int64_t>{5, 6, 8}));
  for (const int ranks : {2, 3}) EXPECT_EQ(Ids(scene, ranks), Ids(scene)) << "rows left out count on no rank";
  const std::vector<BodyDefinition> bodies = Bodies(scene);
  EXPECT_EQ(bodies[0].kind, BodyKind::kFree);
  EXPECT_EQ(bodies[1].kind, BodyKind::kPrescribed);
  EXPECT_EQ(bodies[1].mass, 0.0);
  EXPECT_EQ(bodies[1].velocity.vx, 4.0);
  ExpectIn("no free body", Refusal("x,y,radius,kind\n1,2,1,prescribed\n"));
}

TEST(FreeIds, AreThoseThatNobodyHas) {
  const FreeIds all;
  EXPECT_EQ(all.At(0), 0);
  EXPECT_EQ(all.At(41), 41);
  EXPECT_EQ(all.NumberOf(41), 41);
  const FreeIds ids({0, 1, 3, 7, 8, std::numeric_limits<std::int64_t>::max()}, 100);
  const std::vector<std::int64_t> expected = {2, 4, 5, 6, 9, 10, 11};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(ids.At(static_cast<std::int64_t>(k)), expected[k]);
    EXPECT_EQ(ids.NumberOf(expected[k]), static_cast<std::int64_t>(k));
  }
  for (const std::int64_t taken : {0, 1, 3, 7, 8}) EXPECT_EQ(ids.NumberOf(taken), std::nullopt) << taken;
  EXPECT_EQ(FreeIds({5, 6}, 5).At(4), 4) << "no more than needed is kept";
  EXPECT_EQ(FreeIds({5, 6}, 6).At(5), 7);
  EXPECT_EQ(FreeIds({}, 0).At(0), 0);
}

TEST(SceneTables, WallsGiveWayToTheIdsOfATable) {
  const TestFolder folder;
  const std::string table = "id,x,y,radius\n1,1,2,0.5\n2,3,2,0.5\n";
  const Scene scene =
      SceneOf(folder, table,
              kTime + kWall + kWall + kWall + "[[disks]]\nfile = \"d.csv\"\n" + "[[disks]]\ncentre = [0, 9]\nradius = 1\n");
  const std::vector<std::int64_t> expected = {0, 3, 4, 1, 2, 5};
  for (const int ranks : {1, 2, 3, 5}) EXPECT_EQ(Ids(scene, ranks), expected) << ranks << " ranks";
}

TEST(SceneTables, AnIdThatTwoBodiesHaveIsRefused) {
  const std::string wall = "[[walls]]\nid = 2\ntype = \"half_plane\"\npoint = [0, 0]\n";
  ExpectIn("d.csv:3: 2 is a duplicate",
           Refusal("id,x,y,radius\n1,1,2,0.5\n2,3,2,0.5\n", kTime + wall + "[[disks]]\nfile = \"d.csv\"\n"));
  ExpectIn("d.csv:2: 1 is a duplicate", Refusal("id,x,y,radius\n1,1,2,0.5\n", kTable + "[[disks]]\nfile = \"d.csv\"\n"));
}

TEST(SceneTables, RolesOfBodies) {
  const TestFolder folder;
  const Scene scene = SceneOf(folder, "id,x,y,radius\n1,1,2,0.5\n2,3,2,0.5\n", kTime + kWall + kWall + R"(
[[walls]]
id = 70
type = "half_plane"
point = [0, 0]
[[disks]]
file = "d.csv"
[[disks]]
centre = [0, 9]
radius = 1
[[clusters]]
disks = [[0, 0, 1]]
at = [[5, 20, 0], [8, 20, 0]]
[[clusters]]
id = 90
disks = [[0, 30, 1]]
)");
  EXPECT_EQ(Ids(scene), (std::vector<std::int64_t>{0, 3, 70, 1, 2, 4, 5, 6, 90}));
  const BodyRoles roles(scene);
  std::vector<std::string> found;
  for (const std::int64_t id : Ids(scene)) found.emplace_back(roles.Of(id));
  EXPECT_EQ(found, (std::vector<std::string>{"wall", "wall", "wall", "", "", "", "cluster", "cluster", "cluster"}));
}

}  // namespace
}  // namespace nscdd
