// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "render/paint.h"

namespace nscdd {
namespace {

struct Unit {
  double size;  ///< [m]
  const char* name;
};
constexpr std::array<Unit, 5> kUnits = {{{1e3, "km"}, {1.0, "m"}, {1e-3, "mm"}, {1e-6, "\u00b5m"}, {1e-9, "nm"}}};

std::string FormatLength(double metres) {
  for (const Unit& unit : kUnits) {
    if (metres >= 0.999 * unit.size) return fmt::format("{:.3g} {}", metres / unit.size, unit.name);
  }
  return fmt::format("{:.3g} m", metres);
}

/// Largest of 1, 2, 5 x 10^k that is not larger.
double RoundDown(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= value) return factor * decade;
  }
  return decade;
}

/// Base line of the text below scale bar and colour bar.
double CaptionLine(const Layout& layout) { return layout.band_top + 3.1 * layout.font; }

double RightEdge(const Layout& layout) { return layout.width - layout.margin; }

double EntryWidth(const Layout& layout, const LegendEntry& entry, Picture* picture) {
  const double sample = entry.line_width > 0.0 ? 2.6 : 1.2;
  return (sample + 0.5) * layout.font + picture->TextWidth(entry.text, layout.font);
}

/// Sample at `x`, centred on `middle`; returns where its text begins.
double PaintSample(const Layout& layout, const LegendEntry& entry, double x, double middle, Picture* picture) {
  picture->SetColour(entry.colour);
  if (entry.line_width > 0.0) {
    cairo_set_line_cap(picture->context(), CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(picture->context(), entry.line_width);
    cairo_move_to(picture->context(), x, middle);
    cairo_line_to(picture->context(), x + 2.6 * layout.font, middle);
    cairo_stroke(picture->context());
    return x + 3.1 * layout.font;
  }
  const double side = 1.2 * layout.font;
  picture->FillRectangle({x, middle - side / 2.0}, side, side);
  picture->SetColour({0.4, 0.4, 0.4});
  cairo_set_line_width(picture->context(), 1.0);
  cairo_rectangle(picture->context(), x, middle - side / 2.0, side, side);
  cairo_stroke(picture->context());
  return x + 1.7 * layout.font;
}

}  // namespace

void PaintTitle(const Layout& layout, const std::string& title, const std::string& subtitle, Picture* picture) {
  const double room = RightEdge(layout) - layout.margin;
  const auto fitted = [&](const std::string& text, double size, bool bold) {
    return size * std::min(1.0, room / std::max(1.0, picture->TextWidth(text, size, bold)));
  };
  picture->SetColour(kInk);
  picture->Text({layout.margin, layout.margin + 1.2 * layout.font}, title, fitted(title, 1.35 * layout.font, true), 0.0, true);
  picture->Text({layout.margin, layout.margin + 2.7 * layout.font}, subtitle, fitted(subtitle, layout.font, false));
}

void PaintScaleBar(const Layout& layout, Picture* picture) {
  const double metres = RoundDown(0.22 * layout.width / layout.scale);
  const double length = metres * layout.scale, thickness = 0.35 * layout.font;
  const double y = layout.band_top + 1.4 * layout.font;
  picture->SetColour(kInk);
  picture->FillRectangle({layout.margin, y}, length, thickness);
  picture->FillRectangle({layout.margin, y - thickness}, 2.0, 3.0 * thickness);
  picture->FillRectangle({layout.margin + length - 2.0, y - thickness}, 2.0, 3.0 * thickness);
  picture->Text({layout.margin + length / 2.0, CaptionLine(layout)}, FormatLength(metres), layout.font, 0.5);
}

void PaintLegend(const Layout& layout, const std::vector<LegendEntry>& entries, Picture* picture) {
  // Right-aligned rows, from the first entry on; a new row where the scale bar would be run into.
  const double room = RightEdge(layout) - (layout.margin + 0.27 * layout.width);
  double middle = layout.band_top + 1.5 * layout.font;
  for (std::size_t begin = 0; begin < entries.size();) {
    double width = 0.0;
    std::size_t end = begin;
    for (; end < entries.size(); ++end) {
      const double more = EntryWidth(layout, entries[end], picture) + (end > begin ? 1.4 * layout.font : 0.0);
      if (end > begin && width + more > room) break;
      width += more;
    }
    double x = RightEdge(layout) - width;
    for (; begin < end; ++begin) {
      const double text = PaintSample(layout, entries[begin], x, middle, picture);
      picture->SetColour(kInk);
      picture->Text({text, middle + 0.36 * layout.font}, entries[begin].text, layout.font);
      x += EntryWidth(layout, entries[begin], picture) + 1.4 * layout.font;
    }
    middle += 1.9 * layout.font;
  }
}

void PaintSpeedBar(const Layout& layout, double largest, Picture* picture) {
  const double length = 0.32 * layout.width, left = RightEdge(layout) - length;
  const double top = layout.band_top + 0.8 * layout.font, thickness = 1.1 * layout.font;
  const std::unique_ptr<cairo_pattern_t, void (*)(cairo_pattern_t*)> ramp(
      cairo_pattern_create_linear(left, 0.0, left + length, 0.0), cairo_pattern_destroy);
  constexpr int kStops = 32;
  for (int i = 0; i <= kStops; ++i) {
    const double value = static_cast<double>(i) / kStops;
    const Colour colour = SpeedColour(value);
    cairo_pattern_add_color_stop_rgb(ramp.get(), value, colour.red, colour.green, colour.blue);
  }
  cairo_set_source(picture->context(), ramp.get());
  picture->FillRectangle({left, top}, length, thickness);
  picture->SetColour(kInk);
  picture->Text({left, CaptionLine(layout)}, "0", layout.font);
  picture->Text({left + length / 2.0, CaptionLine(layout)}, "speed", layout.font, 0.5);
  picture->Text({left + length, CaptionLine(layout)}, fmt::format("{:.3g} m/s", largest), layout.font, 1.0);
}

}  // namespace nscdd
