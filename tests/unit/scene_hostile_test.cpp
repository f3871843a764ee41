// SPDX-License-Identifier: Apache-2.0
// Files that mean harm: refused with a sentence, at once, on little memory and stack.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/platform.h"
#include "scene/read_scene.h"
#include "scene/text.h"
#include "scene/toml_file.h"
#include "scene_files.h"

namespace nscdd {
namespace {

const std::string kTime = "[time]\ndt = 0.01\nsteps = 3\n";
const std::string kDisk = "[[disks]]\ncentre = [0, 1]\nradius = 1\n";

std::string Repeat(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

/// What `work` refuses with; "accepted" if it does not.
std::string Refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string SceneRefusal(const std::string& text, const std::string& disks = "") {
  const TestFolder folder;
  folder.Write("disks.csv", disks);
  const auto path = folder.Write("bad.toml", text);
  return Refusal([&] { ReadSceneFile(path); });
}

void ExpectIn(const std::string& fragment, const std::string& sentence) {
  EXPECT_NE(sentence.find(fragment), std::string::npos) << sentence;
  EXPECT_LT(sentence.size(), 1200u);
  EXPECT_FALSE(HasControls(sentence)) << sentence;
  EXPECT_EQ(FirstLineOutsideUtf8(sentence), 0) << sentence;
}

TEST(Hostile, DeepNesting) {
  const std::string good = kTime + kDisk;
  ExpectIn("16 parts", SceneRefusal(good + "[solver]\n" + Repeat("a.", 1000000) + "a = 1\n"));
  ExpectIn("16 parts", SceneRefusal(good + "[" + Repeat("a . ", 100000) + "a]\n"));
  ExpectIn("16 parts", SceneRefusal(good + "x = { y = \"\"\" \" \"\"\", " + Repeat("a.", 100000) + "a = 1 }\n"));
  ExpectIn("valid TOML", SceneRefusal(good + "x = " + Repeat("[", 100000) + Repeat("]", 100000) + "\n"));
  ExpectIn("valid TOML", SceneRefusal(good + "x = " + Repeat("{a=", 100000) + "1" + Repeat("}", 100000) + "\n"));
}

TEST(Hostile, DepthOfKeys) {
  EXPECT_EQ(FirstLineOfDeepKey("a.b.c = 1.5\n", 3), 0);
  EXPECT_EQ(FirstLineOfDeepKey("\n\na.b.c.d = 1\n", 3), 3);
  EXPECT_EQ(FirstLineOfDeepKey("x = [[0.5, 1.5], [2.5, 3.5, 4.5]]\n", 3), 0);
  EXPECT_EQ(FirstLineOfDeepKey("t = \"....\" # ....\nu = '....\\'\nv = \"\\\"....\"\n", 3), 0);
  EXPECT_EQ(FirstLineOfDeepKey("t = '''\n....\n' ''\n''' # .\n", 3), 0);
  EXPECT_EQ(FirstLineOfDeepKey("t = \"\"\"\n....\n\"\"\"\na.a.'.'.a.a = 1\n", 3), 4);
  EXPECT_EQ(FirstLineOfDeepKey("t = 'open\na.a.a.a = 1\n", 3), 2);
  EXPECT_EQ(FirstLineOfDeepKey("t = \"\\", 3), 0);
}

TEST(Hostile, TextsWithControls) {
  ExpectIn("control", SceneRefusal("[scene]\ntitle = \"\\u001b[31m\"\n" + kTime + kDisk));
  ExpectIn("control", SceneRefusal(kTime + "[[disks]]\nfile = \"disks.csv\\u0000.png\"\n", "x,y,radius\n1,2,3\n"));
  ExpectIn("disks[1].a?b'", SceneRefusal(kTime + kDisk + "\"a\\u001bb\" = 1\n"));
  ExpectIn("[...]", SceneRefusal(kTime + kDisk + std::string(1000000, 'x') + " = 1\n"));
}

TEST(Hostile, NamesOfFiles) {
  for (const char* name : {"/no/such", "../disks.csv", "a/../../disks.csv", "..", ".", "a/..", "/dev/zero", "disks.csv/"}) {
    ExpectIn("disks[1].file", SceneRefusal(kTime + "[[disks]]\nfile = \"" + name + "\"\n", "x,y,radius\n1,2,3\n"));
  }
  for (const char* name : {"/tmp", "../out", "a/../b"}) {
    ExpectIn("output.dir", SceneRefusal(kTime + kDisk + "[output]\ndir = \"" + name + "\"\n"));
  }
  for (const char* name : {"../p.csv", ".p", "a/b"}) {
    ExpectIn("output.packing", SceneRefusal(kTime + kDisk + "[output]\npacking = \"" + name + "\"\n"));
  }
}

TEST(Hostile, PackingsThatAreNoText) {
  const std::string scene = kTime + "[[disks]]\nfile = \"disks.csv\"\n", head = "x,y,radius\n1,2,3\n";
  using namespace std::string_literals;
  EXPECT_EQ(SceneRefusal(scene, head + "\t4,5,6\r\n# \xC3\xA9\n"), "accepted");
  EXPECT_EQ(SceneRefusal(scene, head + "4,5,6"), "accepted");
  ExpectIn("disks.csv:3: has a control", SceneRefusal(scene, head + "4,5,6\0,hidden\n"s));
  ExpectIn("disks.csv:3: has a control", SceneRefusal(scene, head + "4,5,6\0"s));
  ExpectIn("disks.csv:3: has a control", SceneRefusal(scene, head + "4,5,\x1b[31m\n"));
  ExpectIn("disks.csv:3: is not UTF-8", SceneRefusal(scene, head + "# caf\xE9\n"));
  ExpectIn("disks.csv:3", SceneRefusal(scene, head + "4,5," + std::string(100000, '6') + "\n"));
  for (const char* number : {"nan", "inf", "-inf", "NaN", "1e999", "0x10", "1,000", "", "1e", "--1"}) {
    ExpectIn("disks.csv:3", SceneRefusal(scene, head + number + ",5,6\n"));
  }
}

TEST(Hostile, Counts) {
  const TestFolder folder;
  const auto path =
      folder.Write("bad.toml", kTime + "[[lattices]]\ncount = 1000000000\nx = [0, 1000]\nbottom = 0\nradius = 1\n");
  const Scene scene = ReadSceneFile(path);
  const auto nothing = [](const BodyDefinition&) { FAIL() << "a body was made"; };
  ExpectIn("1000000000 bodies", Refusal([&] { ForEachBody(scene, 0, 1, nothing); }));
  ExpectIn("more ranks", Refusal([&] { ForEachBody(scene, 3, 7, nothing); }));
  const std::string wall =
      "[[walls]]\ntype = \"disks\"\nradius = 1e-6\npoints = [[0, 0], [0, 1]" + Repeat(", [1, 0], [1, 1]", 100) + "]\n";
  ExpectIn("spacing", SceneRefusal(kTime + kDisk + wall));
  ExpectIn("shapes",
           SceneRefusal(kTime + kDisk + Repeat("[[walls]]\ntype = \"segments\"\ncircle = [0, 0, 1]\nsides = 1000000\n", 4)));
  std::string at = "at = [[0, 0, 0]", disks = "disks = [[0, 0, 1]";
  for (int i = 0; i < 10000; ++i) at += ", [0, 0, 0]", disks += ", [0, 0, 1]";
  ExpectIn("places", SceneRefusal(kTime + "[[clusters]]\n" + at + "]\n" + disks + "]\n"));
}

TEST(Hostile, NumbersBeyondTheRangeOfBox2d) {
  const TestFolder folder;
  const auto build = [&](const std::string& bodies) {
    const Scene scene = ReadSceneFile(folder.Write("far.toml", kTime + bodies));
    const auto platform = MakePlatform("box2d", scene);
    ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  };
  EXPECT_EQ(Refusal([&] { build(kDisk); }), "accepted");
  ExpectIn("Body 0", Refusal([&] { build("[[disks]]\ncentre = [1e300, 0]\nradius = 1\n"); }));
  ExpectIn("reference", Refusal([&] { build("[[disks]]\ncentre = [0, 0]\nradius = 1\nangle = 1e40\n"); }));
  ExpectIn("Body 0", Refusal([&] { build("[[clusters]]\ndisks = [[0, 0, 1]]\nmass = 1e40\n"); }));
  ExpectIn("Body 0", Refusal([&] { build(kDisk + "[[walls]]\ntype = \"segments\"\npoints = [[0, 0], [1e30, 0]]\n"); }));
}

TEST(Printable, LeavesTextAndReplacesTheRest) {
  EXPECT_EQ(Printable("r\xC3\xA9sum\xC3\xA9 'x'"), "r\xC3\xA9sum\xC3\xA9 'x'");
  EXPECT_EQ(Printable("a\x1b[2J\n\x7F\xFF\xC3"), "a?[2J????");
  const std::string cut = Printable(std::string(5000, 'a') + "end");
  EXPECT_LT(cut.size(), 1100u);
  EXPECT_TRUE(cut.ends_with("end"));
  EXPECT_EQ(Printable(std::string(1000, 'a')), std::string(1000, 'a'));
}

}  // namespace
}  // namespace nscdd
