// SPDX-License-Identifier: Apache-2.0
#include "render/picture.h"

#include <cairo-svg.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "nscdd/error.h"

namespace nscdd {
namespace {

constexpr std::array<Colour, 9> kViridis = {{{0.267, 0.005, 0.329},
                                             {0.279, 0.175, 0.483},
                                             {0.230, 0.322, 0.546},
                                             {0.173, 0.449, 0.558},
                                             {0.128, 0.567, 0.551},
                                             {0.158, 0.684, 0.502},
                                             {0.369, 0.789, 0.383},
                                             {0.678, 0.864, 0.190},
                                             {0.993, 0.906, 0.144}}};

constexpr std::array<Colour, kLargestMultiplicityColour + 1> kMultiplicities = {{{0.96, 0.96, 0.96},
                                                                                 {0.80, 0.80, 0.80},
                                                                                 {0.27, 0.28, 0.31},
                                                                                 {0.90, 0.56, 0.00},
                                                                                 {0.00, 0.45, 0.75},
                                                                                 {0.84, 0.20, 0.20},
                                                                                 {0.55, 0.20, 0.65}}};

}  // namespace

Colour SpeedColour(double value) {
  const double position = std::clamp(value, 0.0, 1.0) * (kViridis.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(position), kViridis.size() - 2);
  const double t = position - static_cast<double>(i);
  const Colour a = kViridis[i], b = kViridis[i + 1];
  return {std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t)};
}

Colour MultiplicityColour(std::int32_t multiplicity) {
  return kMultiplicities[static_cast<std::size_t>(std::clamp(multiplicity, 0, kLargestMultiplicityColour))];
}

bool IsSvg(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".svg") {
    throw Error(fmt::format("cannot draw into '{}': give a name that ends in .png or .svg.", file.string()));
  }
  return ending == ".svg";
}

Picture::Picture(const std::filesystem::path& file, int width, int height)
    : file_(file), part_(file.string() + ".part"), is_svg_(IsSvg(file)) {
  if (is_svg_) {
    surface_.reset(cairo_svg_surface_create(part_.c_str(), width, height));
    cairo_svg_surface_set_document_unit(surface_.get(), CAIRO_SVG_UNIT_PX);
  } else {
    surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  }
  context_.reset(cairo_create(surface_.get()));
  const cairo_status_t status = cairo_status(context_.get());
  if (status != CAIRO_STATUS_SUCCESS) ThrowCannotWrite(cairo_status_to_string(status));
  SetColour({1.0, 1.0, 1.0});
  cairo_paint(context_.get());
}

Picture::~Picture() {
  if (!surface_) return;
  cairo_surface_finish(surface_.get());
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Picture::SetColour(Colour colour, double alpha) {
  cairo_set_source_rgba(context_.get(), colour.red, colour.green, colour.blue, alpha);
}

void Picture::FillRectangle(Vec2 corner, double width, double height) {
  cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
  cairo_fill(context_.get());
}

double Picture::TextWidth(const std::string& text, double size, bool bold) {
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

void Picture::Text(Vec2 at, const std::string& text, double size, double anchor, bool bold) {
  const double width = TextWidth(text, size, bold);
  cairo_move_to(context_.get(), at.x - anchor * width, at.y);
  cairo_show_text(context_.get(), text.c_str());
}

void Picture::ThrowCannotWrite(const std::string& reason) {
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  throw Error(fmt::format("cannot write {} ({}): mend its folder's permissions, or choose another file with -o.",
                          file_.string(), reason));
}

void Picture::Save() {
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS && !is_svg_) status = cairo_surface_write_to_png(surface_.get(), part_.c_str());
  cairo_surface_finish(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  if (status != CAIRO_STATUS_SUCCESS) ThrowCannotWrite(cairo_status_to_string(status));
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) ThrowCannotWrite(error.message());
  context_.reset();
  surface_.reset();
}

}  // namespace nscdd
