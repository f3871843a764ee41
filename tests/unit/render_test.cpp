// SPDX-License-Identifier: Apache-2.0
// Pictures: what is painted where, sizes and refusals. Pixels are looked at through Cairo.
#include "render/render.h"

#include <cairo.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "render/drawing.h"
#include "render/picture.h"
#include "results/results_file.h"
#include "results_sample.h"

namespace nscdd {
namespace {

namespace fs = std::filesystem;

void Save(const fs::path& folder, const RunDescription& run, const GrainTable& grains, const ContactRows& contacts,
          const ShapeTable& shapes) {
  ResultsFolder results(folder, IdentityOf(run.scene), RankGroup());
  ResultsFile file(&results, run, shapes);
  file.Save({1, 0.1, 1.0}, grains, {});
  file.Save({50, 0.5, 1.0}, grains, contacts);
  file.Close();
  results.Finish();
}

void SaveSample(const fs::path& folder) {
  Save(folder, {"sample", "nscdd", "0.1.0", 2, 1, 0.0, 0.0}, SampleGrains(), SampleContacts(), SampleShapes());
}

/// The pixels of a PNG.
class Pixels {
 public:
  explicit Pixels(const fs::path& file) : surface_(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {}

  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  /// 0xRRGGBB
  unsigned At(Vec2 pixel) const {
    const unsigned char* row = cairo_image_surface_get_data(surface_.get()) +
                               static_cast<std::ptrdiff_t>(pixel.y) * cairo_image_surface_get_stride(surface_.get());
    unsigned colour = 0;
    std::memcpy(&colour, row + 4 * static_cast<std::ptrdiff_t>(pixel.x), sizeof colour);
    return colour & 0xffffffU;
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
};

/// Whether the pixel has the colour, but for what Cairo rounds.
::testing::AssertionResult Shows(const Pixels& picture, Vec2 pixel, Colour colour) {
  const unsigned seen = picture.At(pixel);
  const auto differs = [&](unsigned shift, double value) {
    return std::abs(static_cast<double>(seen >> shift & 0xffU) - 255.0 * value) > 1.5;
  };
  if (!differs(16, colour.red) && !differs(8, colour.green) && !differs(0, colour.blue)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << fmt::format("{:06x} is at {:.1f}, {:.1f}", seen, pixel.x, pixel.y);
}

class RenderSample : public ::testing::Test {
 protected:
  RenderSample() { SaveSample(folder_.path()); }
  Pixels Draw(Show show) { return Pixels(Render({folder_.path(), {}, show, folder_.path() / "picture.png"}).file); }
  /// Where a point of the sample is in its pictures.
  Vec2 At(Vec2 point) const { return MakeLayout(ReadDrawing(folder_.path(), {})).ToPixels(point); }

  TemporaryFolder folder_;
};

TEST_F(RenderSample, MultiplicityColoursTheGrains) {
  const Pixels picture = Draw(Show::kMultiplicity);
  EXPECT_TRUE(Shows(picture, At({1.0, 1.3}), MultiplicityColour(2)));
  EXPECT_TRUE(Shows(picture, At({3.0, 1.3}), MultiplicityColour(3)));
  EXPECT_TRUE(Shows(picture, At({5.0, 1.3}), MultiplicityColour(1)));
  EXPECT_TRUE(Shows(picture, At({3.0, -0.4}), kWall));  // disk of the wall, half a radius below its centre of mass
  EXPECT_TRUE(Shows(picture, At({0.0, 0.0}), kInk));    // its segment
}

TEST_F(RenderSample, ForcesAreLinesBetweenCentres) {
  const Pixels picture = Draw(Show::kForces);
  EXPECT_TRUE(Shows(picture, At({1.5, 1.0}), kChain));
  EXPECT_TRUE(Shows(picture, At({2.5, 1.0}), kChain));
  EXPECT_TRUE(Shows(picture, At({4.5, 1.0}), kPale));  // open contact
  EXPECT_TRUE(Shows(picture, At({3.0, 0.3}), kChain));
  EXPECT_TRUE(Shows(picture, At({5.0, 1.3}), kPale));
}

TEST_F(RenderSample, LargestOverlapIsRed) {
  const Pixels picture = Draw(Show::kOverlap);
  EXPECT_TRUE(Shows(picture, At({1.5, 1.0}), kOverlapRed));
  EXPECT_TRUE(Shows(picture, At({1.0, 1.5}), MultiplicityColour(2)));
  EXPECT_TRUE(Shows(picture, At({3.0, 1.5}), MultiplicityColour(2)));  // dark, as any grain of several subdomains
  EXPECT_TRUE(Shows(picture, At({4.5, 1.0}), MultiplicityColour(1)));
}

TEST_F(RenderSample, GrainsAreColouredBySpeedAndTicked) {
  const Pixels picture = Draw(Show::kGrains);
  EXPECT_TRUE(Shows(picture, At({3.0, 1.5}), SpeedColour(1.0)));
  EXPECT_TRUE(Shows(picture, At({5.0, 1.5}), SpeedColour(0.0)));
  EXPECT_TRUE(Shows(picture, At(Vec2{5.0, 1.0} + Rotate(0.1, {0.5, 0.0})), {1.0, 1.0, 1.0}));
}

TEST_F(RenderSample, DefaultsAreTheLastStepAndANameInTheFolder) {
  const RenderedPicture picture = Render({folder_.path(), {}, Show::kForces, {}});
  EXPECT_EQ(picture.file, folder_.path() / "forces_000050.png");
  EXPECT_EQ(picture.step, 50);
  const Pixels pixels(picture.file);
  EXPECT_EQ(pixels.width(), picture.width);
  EXPECT_EQ(pixels.height(), picture.height);
  EXPECT_TRUE(fs::exists(Render({folder_.path(), 1, Show::kForces, {}}).file));  // no contacts at all
}

TEST_F(RenderSample, SvgIsWrittenToo) {
  Render({folder_.path(), {}, Show::kGrains, folder_.path() / "a.svg"});
  EXPECT_NE(TextOf(folder_.path() / "a.svg").find("</svg>"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_.path() / "a.svg.part"));
}

TEST_F(RenderSample, RefusalsAreSentences) {
  const auto sentence = [&](std::optional<std::int64_t> step, const fs::path& output) {
    return SentenceOf([&] { Render({folder_.path(), step, Show::kGrains, output}); });
  };
  EXPECT_NE(sentence({}, "a.jpg").find(".png or .svg"), std::string::npos);
  EXPECT_NE(sentence(3, "").find("1, 50"), std::string::npos);
  EXPECT_NE(sentence({}, folder_.path() / "no" / "a.png").find("cannot write"), std::string::npos);
  EXPECT_NE(sentence({}, folder_.path() / "no" / "a.svg").find("cannot write"), std::string::npos);
  EXPECT_NE(SentenceOf([] { ParseShow("grain"); }).find("multiplicity"), std::string::npos);
  EXPECT_NE(SentenceOf([] { Render({"/nonexistent", {}, Show::kGrains, {}}); }).find("/nonexistent"), std::string::npos);
}

TEST(Render, ShowsAreNamed) {
  for (const Show show : {Show::kGrains, Show::kForces, Show::kMultiplicity, Show::kOverlap}) {
    EXPECT_EQ(ParseShow(ShowName(show)), show);
  }
}

/// A square lattice of unit disks.
GrainTable Lattice(int side) {
  GrainTable grains;
  const int count = side * side;
  for (int i = 0; i < count; ++i) {
    grains.id.push_back(i);
    grains.x.push_back(2.0 * (i % side));
    grains.y.push_back(2.0 * (i / side));
  }
  for (auto* column : {&grains.angle, &grains.vx, &grains.vy, &grains.spin}) column->resize(grains.id.size());
  grains.radius.resize(grains.id.size(), 1.0);
  grains.multiplicity.resize(grains.id.size(), 1);
  grains.subdomain.resize(grains.id.size());
  grains.kind.resize(grains.id.size());
  return grains;
}

TEST(Render, SizesFitFewAndManyGrains) {
  for (const int side : {1, 3, 30, 200}) {
    const TemporaryFolder folder;
    Save(folder.path(), {"lattice", "nscd", "0.1.0", 1, 1, 0.0, 0.0}, Lattice(side), {}, {});
    const RenderedPicture picture = Render({folder.path(), {}, Show::kGrains, {}});
    EXPECT_GE(picture.width, 600) << side;
    EXPECT_LE(picture.width, 2400) << side;
    EXPECT_LE(picture.height, 2400) << side;
  }
}

TEST(Render, PeriodicImagesAreDrawn) {
  const TemporaryFolder folder;
  GrainTable grains = Lattice(2);
  for (double& x : grains.x) x -= 0.5;  // the first column reaches over the left border at -0.5, by half
  Save(folder.path(), {"flow", "nscd", "0.1.0", 1, 1, 4.0, -0.5}, grains, {}, {});
  const Drawing drawing = ReadDrawing(folder.path(), {});
  EXPECT_EQ(drawing.box.low.x, -0.5);
  EXPECT_EQ(drawing.box.high.x, 3.5);
  const Pixels picture(Render({folder.path(), {}, Show::kMultiplicity, {}}).file);
  const Layout layout = MakeLayout(drawing);
  EXPECT_TRUE(Shows(picture, layout.ToPixels({-0.3, 0.3}), MultiplicityColour(1)));
  EXPECT_TRUE(Shows(picture, layout.ToPixels({3.3, 0.3}), MultiplicityColour(1)));
  EXPECT_TRUE(Shows(picture, layout.ToPixels({0.55, 1.0}), {1.0, 1.0, 1.0}));  // between the disks
}

TEST(Drawing, ContactsEndInTheNearestDiskOfAClusterAndAcrossThePeriod) {
  const TemporaryFolder folder;
  GrainTable grains = Lattice(1);
  grains = Lattice(2);  // ids 0..3 at (0,0) (2,0) (0,2) (2,2)
  ShapeTable shapes;    // body 1 is two disks, turned by a quarter
  shapes.body = {1, 1};
  shapes.kind = {ShapeKind::kDisk, ShapeKind::kDisk};
  shapes.x0 = {-0.5, 0.5};
  shapes.y0 = {0.0, 0.0};
  shapes.x1 = shapes.y1 = {0.0, 0.0};
  shapes.radius = {0.5, 0.5};
  grains.angle[1] = std::numbers::pi / 2.0;
  ContactRows contacts = SampleContacts();
  contacts.body_a = {1, 0, 2};
  contacts.body_b = {3, 1, 3};
  contacts.point_x = {2.0, -1.0, 99.0};
  contacts.point_y = {1.0, 0.0, 99.0};
  Save(folder.path(), {"flow", "nscd", "0.1.0", 1, 1, 4.0, -0.5}, grains, contacts, shapes);
  const Drawing drawing = ReadDrawing(folder.path(), {});
  ASSERT_EQ(drawing.contacts.size(), 3u);
  EXPECT_NEAR(drawing.contacts[0].from.x, 2.0, 1e-12);
  EXPECT_NEAR(drawing.contacts[0].from.y, 0.5, 1e-12);  // the upper disk
  EXPECT_NEAR(drawing.contacts[1].from.x, 0.0, 1e-12);
  EXPECT_NEAR(drawing.contacts[1].to.x, -2.0, 1e-12);  // body 1 one period to the left
}

}  // namespace
}  // namespace nscdd
