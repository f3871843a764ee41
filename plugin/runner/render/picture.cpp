// SPDX-License-Identifier: Apache-2.0
#include "render/picture.h"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <system_error>

#include "nscdd/error.h"

namespace nscdd {

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
