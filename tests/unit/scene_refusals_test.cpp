// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nscdd/error.h"
#include "scene/read_scene.h"
#include "scene_files.h"

namespace nscdd {
namespace {

const std::string kTime = "[time]\ndt = 0.01\nsteps = 3\n";            // lines 1 to 3
const std::string kDisk = "[[disks]]\ncentre = [0, 1]\nradius = 1\n";  // three lines
const std::string kGood = kTime + kDisk;                               // lines 1 to 6

/// What ReadSceneFile says; empty if it accepts the file.
std::string Refusal(const std::filesystem::path& path) {
  try {
    ReadSceneFile(path);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

struct BadScene {
  std::string name;
  std::string text;
  int line;                            ///< that the sentence must name
  std::vector<std::string> fragments;  ///< that it must contain
};
void PrintTo(const BadScene& scene, std::ostream* out) { *out << scene.name; }

class BadSceneFile : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneFile, IsRefusedWithFileLineKeyAndMend) {
  const TestFolder folder;
  const auto path = folder.Write("bad.toml", GetParam().text);
  const std::string sentence = Refusal(path);
  EXPECT_TRUE(sentence.starts_with(path.string() + ":" + std::to_string(GetParam().line) + ":")) << sentence;
  for (const std::string& fragment : GetParam().fragments)
    EXPECT_NE(sentence.find(fragment), std::string::npos) << fragment << " in " << sentence;
  EXPECT_TRUE(sentence.ends_with(".") || sentence.ends_with("?")) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

std::string WithTime(const std::string& keys) { return "[time]\n" + keys + kDisk; }
std::string More(const std::string& text) { return kGood + text; }  // `text` begins at line 7

INSTANTIATE_TEST_SUITE_P(
    Settings, BadSceneFile,
    testing::Values(
        BadScene{"syntax", "[time\ndt = 1\n", 1, {"not valid TOML"}},
        BadScene{"key_twice", "[time]\ndt = 1\ndt = 2\n", 3, {"not valid TOML"}},
        BadScene{"not_utf8", kTime + "# caf\xE9\n" + kDisk, 4, {"UTF-8"}},
        BadScene{"unknown_table",
                 More("[gravitiy]\nvector = [0, 1]\n"),
                 7,
                 {"key 'gravitiy'", "unknown", "did you mean 'gravity'?"}},
        BadScene{"unknown_key", WithTime("dt = 1\nstep = 3\nsteps = 3\n"), 3, {"key 'time.step'", "did you mean 'steps'?"}},
        BadScene{"unknown_key_far",
                 WithTime("dt = 1\nsteps = 3\nzzzzzz = 1\n"),
                 4,
                 {"'time.zzzzzz'", "known keys are dt, steps, theta"}},
        BadScene{"no_time", kDisk, 1, {"key 'time'", "missing", "dt and steps"}},
        BadScene{"no_dt", WithTime("steps = 3\n"), 1, {"key 'time.dt'", "missing", "number > 0 [s]"}},
        BadScene{"text_dt", WithTime("dt = \"10 ms\"\nsteps = 3\n"), 2, {"'time.dt'", "is a text", "[s]"}},
        BadScene{"zero_dt", WithTime("dt = 0\nsteps = 3\n"), 2, {"'time.dt' is 0", "> 0"}},
        BadScene{"negative_dt", WithTime("dt = -0.5\nsteps = 3\n"), 2, {"'time.dt' is -0.5"}},
        BadScene{"nan_dt", WithTime("dt = nan\nsteps = 3\n"), 2, {"'time.dt' is nan"}},
        BadScene{"inf_dt", WithTime("dt = inf\nsteps = 3\n"), 2, {"'time.dt' is inf"}},
        BadScene{"real_steps", WithTime("dt = 1\nsteps = 3.5\n"), 3, {"'time.steps'", "integer"}},
        BadScene{"zero_steps", WithTime("dt = 1\nsteps = 0\n"), 3, {"'time.steps' is 0"}},
        BadScene{"theta", WithTime("dt = 1\nsteps = 1\ntheta = nan\n"), 4, {"'time.theta' is nan"}},
        BadScene{"time_is_list", "time = [1]\n" + kDisk, 1, {"key 'time' is a list", "table [time]"}},
        BadScene{"scene_name", "[scene]\nname = \"a/b\"\n" + kGood, 2, {"'scene.name'", "letters"}},
        BadScene{"adapter", "[scene]\nadapter = \"box3d\"\n" + kGood, 2, {"'scene.adapter'", "did you mean 'box2d'?"}},
        BadScene{"gravity_nan", More("[gravity]\nvector = [nan, 0]\n"), 8, {"'gravity.vector'", "nan", "finite"}},
        BadScene{"gravity_short", More("[gravity]\nvector = [1]\n"), 8, {"'gravity.vector'", "2 numbers"}},
        BadScene{"gravity_kind", More("[gravity]\nkind = \"rotatin\"\n"), 8, {"'gravity.kind'", "did you mean 'rotating'?"}},
        BadScene{
            "gravity_foreign_key", More("[gravity]\nvector = [0, 1]\nin_steps = 4\n"), 9, {"'gravity.in_steps'", "unknown"}},
        BadScene{"rotating_both",
                 More("[gravity]\nkind = \"rotating\"\nfrom_angle = 0\nto_angle = 1\nin_steps = 3\nin_time = 1\n"),
                 11,
                 {"'gravity.in_steps'", "exactly one"}},
        BadScene{"rotating_one_step",
                 More("[gravity]\nkind = \"rotating\"\nfrom_angle = 0\nto_angle = 1\nin_steps = 1\n"),
                 11,
                 {"'gravity.in_steps' is 1", "from 2"}},
        BadScene{"table_order",
                 More("[gravity]\nkind = \"table\"\ntable = [[0, 0, 1], [0, 0, 2]]\n"),
                 9,
                 {"'gravity.table'", "ascending"}},
        BadScene{"period", More("[periodic]\nx = [0, -1]\n"), 8, {"'periodic.x'", "length > 0"}},
        BadScene{"solver_list",
                 More("[solver]\nname = \"nscd\"\nsubdomains = [1, 2, 3]\n"),
                 9,
                 {"'solver.subdomains'", "pair of integers"}},
        BadScene{"solver_inf", More("[solver]\ntolerance = inf\n"), 8, {"'solver.tolerance' is inf"}},
        BadScene{"nonconvergence", More("[solver]\non_nonconvergence = \"stopp\"\n"), 8, {"did you mean 'stop'?"}},
        BadScene{"out_of_tree", More("[output]\ndir = \"../x\"\n"), 8, {"'output.dir'", "'..'"}},
        BadScene{"save_never", More("[output]\nsave_every = 0\n"), 8, {"'output.save_every' is 0"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Bodies, BadSceneFile,
    testing::Values(
        BadScene{"no_bodies", kTime, 1, {"key 'disks'", "missing", "[[lattices]]"}},
        BadScene{"no_free_body", kTime + "[[walls]]\ntype = \"half_plane\"\npoint = [0, 0]\n", 1, {"no free body"}},
        BadScene{"disks_table", kTime + "[disks]\nradius = 1\n", 4, {"key 'disks' is a table", "[[disks]]"}},
        BadScene{"no_radius", kTime + "[[disks]]\ncentre = [0, 1]\n", 4, {"key 'disks[1].radius'", "missing", "[m]"}},
        BadScene{"negative_radius", More("[[disks]]\ncentre = [0, 1]\nradius = -1\n"), 9, {"key 'disks[2].radius' is -1"}},
        BadScene{"tiny_radius", More("[[disks]]\ncentre = [0, 1]\nradius = 1e-200\n"), 9, {"key 'disks[2].radius'", "mass"}},
        BadScene{"huge_radius", More("[[disks]]\ncentre = [0, 1]\nradius = 1e200\n"), 9, {"key 'disks[2].radius'", "mass"}},
        BadScene{"inf_centre", More("[[disks]]\ncentre = [0, -inf]\nradius = 1\n"), 8, {"key 'disks[2].centre'", "finite"}},
        BadScene{"misspelt_body_key",
                 More("[[disks]]\ncenter = [0, 1]\nradius = 1\n"),
                 8,
                 {"key 'disks[2].center'", "did you mean 'centre'?"}},
        BadScene{"negative_id", More("[[disks]]\nid = -1\ncentre = [0, 1]\nradius = 1\n"), 8, {"'disks[2].id' is -1"}},
        BadScene{"duplicate_id",
                 More("[[disks]]\nid = 9\ncentre = [0, 1]\nradius = 1\n[[disks]]\nid = 9\ncentre = [0, 1]\nradius = 1\n"),
                 11,
                 {"'disks[3].id' 9 is a duplicate", ":7: key 'disks[2].id'"}},
        BadScene{"material",
                 More("[[materials]]\nname = \"steel\"\n[[disks]]\ncentre = [0, 1]\nradius = 1\nmaterial = \"stel\"\n"),
                 12,
                 {"'disks[2].material'", "'stel'", "did you mean 'steel'?"}},
        BadScene{"density", More("[[materials]]\nname = \"a\"\ndensity = -2\n"), 9, {"'materials[1].density' is -2"}},
        BadScene{"friction", More("[[materials]]\nname = \"a\"\nfriction = -0.1\n"), 9, {"'materials[1].friction'", ">= 0"}},
        BadScene{"restitution",
                 More("[[materials]]\nname = \"a\"\nrestitution = 1.5\n"),
                 9,
                 {"'materials[1].restitution'", "[0, 1]"}},
        BadScene{"material_twice",
                 More("[[materials]]\nname = \"a\"\n[[materials]]\nname = \"a\"\n"),
                 10,
                 {"'materials[2].name'", "twice"}},
        BadScene{
            "cluster_radius", More("[[clusters]]\ndisks = [[0, 0, 1], [1, 0, 0]]\n"), 8, {"'clusters[1].disks'", "radius 0"}},
        BadScene{"cluster_columns",
                 More("[[clusters]]\ndisks = [[0, 0]]\n"),
                 8,
                 {"'clusters[1].disks'", "3 numbers", "[x, y, radius]"}},
        BadScene{"cluster_mass", More("[[clusters]]\ndisks = [[0, 0, 1]]\nmass = 0\n"), 9, {"'clusters[1].mass' is 0", "[kg]"}},
        BadScene{"wall_type", More("[[walls]]\ntype = \"segment\"\n"), 8, {"'walls[1].type'", "did you mean 'segments'?"}},
        BadScene{"wall_normal",
                 More("[[walls]]\ntype = \"half_plane\"\npoint = [0, 0]\nnormal = [0, 0]\n"),
                 10,
                 {"'walls[1].normal'", "direction"}},
        BadScene{"wall_points",
                 More("[[walls]]\ntype = \"segments\"\npoints = [[0, 0], [0, 0]]\n"),
                 9,
                 {"'walls[1].points'", "different"}},
        BadScene{"wall_spacing",
                 More("[[walls]]\ntype = \"disks\"\npoints = [[0, 0], [1, 0]]\nradius = 1\nspacing = 1e-9\n"),
                 11,
                 {"'walls[1].spacing'", "larger"}},
        BadScene{"lattice_sides",
                 More("[[lattices]]\ncount = 1\nx = [1, 0]\nbottom = 0\nradius = 1\n"),
                 9,
                 {"'lattices[1].x'", "left < right"}},
        BadScene{"lattice_narrow",
                 More("[[lattices]]\ncount = 1\nx = [0, 1]\nbottom = 0\nradius = 1\n"),
                 9,
                 {"'lattices[1].x'", "narrower"}},
        BadScene{"lattice_many",
                 More("[[lattices]]\ncount = 1000000000000\nx = [0, 9]\nbottom = 0\nradius = 1\n"),
                 8,
                 {"'lattices[1].count'"}},
        BadScene{"radius_range",
                 More("[[depositions]]\ncount = 1\nx = [0, 9]\nbottom = 0\nradius = [2, 1]\n"),
                 11,
                 {"'depositions[1].radius'", "[smallest, largest]"}},
        BadScene{"file_is_a_folder", More("[[disks]]\nfile = \"..\"\n"), 8, {"'disks[2].file'", "no file"}},
        BadScene{"file_missing", More("[[disks]]\nfile = \"none.csv\"\n"), 8, {"'disks[2].file'", "none.csv", "no file"}}),
    [](const auto& test) { return test.param.name; });

struct BadCsv {
  std::string name;
  std::string text;
  int line;
  std::string fragment;
};
void PrintTo(const BadCsv& file, std::ostream* out) { *out << file.name; }

class BadDiskFile : public testing::TestWithParam<BadCsv> {};

TEST_P(BadDiskFile, IsRefusedWithFileAndLine) {
  const TestFolder folder;
  const auto csv = folder.Write("d.csv", GetParam().text);
  const std::string sentence = Refusal(folder.Write("s.toml", kTime + "[[disks]]\nfile = \"d.csv\"\n"));
  EXPECT_TRUE(sentence.starts_with(csv.string() + ":" + std::to_string(GetParam().line) + ":")) << sentence;
  EXPECT_NE(sentence.find(GetParam().fragment), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadDiskFile,
    testing::Values(BadCsv{"empty", "", 1, "must name the columns"},
                    BadCsv{"only_comments", "# x y r\n# no more", 2, "no line with names or numbers"},
                    BadCsv{"column", "x,y,radios\n", 1, "did you mean 'radius' by 'radios'?"},
                    BadCsv{"no_column", "x,y\n0,0\n", 1, "column 'radius' is missing"},
                    BadCsv{"column_twice", "x,y,x,radius\n", 1, "'x' is there twice"},
                    BadCsv{"few_fields", "x,y,radius\n# remark\n0,0\n", 3, "2 fields"},
                    BadCsv{"text", "x,y,radius\n0,zero,1\n", 2, "y 'zero' is not a finite number"},
                    BadCsv{"nan", "x,y,radius\n0,0,1\nnan,0,1\n", 3, "x 'nan'"},
                    BadCsv{"inf", "x,y,radius\n0,0,inf\n", 2, "radius 'inf'"},
                    BadCsv{"overflow", "x,y,radius\n0,1e999,1\n", 2, "y '1e999'"},
                    BadCsv{"negative_radius", "x,y,radius\n0,0,-1\n", 2, "radius -1 is not positive"},
                    BadCsv{"bad_id", "id,x,y,radius\n1.5,0,0,1\n", 2, "id '1.5'"},
                    BadCsv{"duplicate_id", "id,x,y,radius\n4,0,0,1\n5,0,0,1\n4,0,0,1\n", 4, "4 is a duplicate"},
                    BadCsv{"material", "x,y,radius,material\n0,0,1,glue\n", 2, "material 'glue'"},
                    BadCsv{"long_line", "x,y,radius\n" + std::string(5000, '1') + "\n", 2, "longer than 4096"}),
    [](const auto& test) { return test.param.name; });

TEST(SceneRefusals, AFileWithoutRowsIsNamed) {
  const TestFolder folder;
  folder.Write("d.csv", "x,y,radius\n");
  EXPECT_NE(Refusal(folder.Write("s.toml", kTime + "[[disks]]\nfile = \"d.csv\"\n")).find("has no disk"), std::string::npos);
}

TEST(SceneRefusals, AMissingSceneIsNamed) {
  EXPECT_NE(Refusal("no_such_scene.toml").find("no_such_scene.toml: there is no such file"), std::string::npos);
  EXPECT_NE(Refusal(SampleScenes()).find("is a folder"), std::string::npos) << "a folder";
}

TEST(SceneRefusals, TheBaseOfTheTableIsGood) {
  const TestFolder folder;
  EXPECT_EQ(Refusal(folder.Write("good.toml", kGood)), "");
}

TEST(SceneRefusals, CoincidentAndOverlappingDisksAreLegal) {
  const TestFolder folder;
  EXPECT_EQ(Refusal(folder.Write("good.toml", kGood + kDisk + kDisk)), "");
}

}  // namespace
}  // namespace nscdd
