// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "nscdd/vector.h"

namespace nscdd {

/// Red, green, blue in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
};

inline constexpr Colour kInk{0.13, 0.13, 0.15};
inline constexpr Colour kWall{0.42, 0.43, 0.46};
inline constexpr Colour kSolid{0.86, 0.86, 0.88};  ///< behind half-planes
inline constexpr Colour kPale{0.90, 0.91, 0.93};   ///< grains behind something else
inline constexpr Colour kChain{0.07, 0.20, 0.45};
inline constexpr Colour kOverlapRed{0.86, 0.05, 0.08};

/// Viridis at `value` in [0, 1]: equal steps look equal, also in grey and to the colour blind.
Colour SpeedColour(double value);

/// Multiplicities from here on share a colour.
inline constexpr std::int32_t kLargestMultiplicityColour = 6;

/// 0 (no contact) nearly white, 1 grey, 2 dark, corners in colours.
Colour MultiplicityColour(std::int32_t multiplicity);

/// A Cairo surface that becomes a PNG or SVG file; coordinates in pixels, y downwards.
class Picture {
 public:
  /// The ending of `file` decides the format; throws Error if it is neither .png nor .svg.
  Picture(const std::filesystem::path& file, int width, int height);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  cairo_t* context() const { return context_.get(); }
  void SetColour(Colour colour, double alpha = 1.0);
  void FillRectangle(Vec2 corner, double width, double height);
  /// `anchor` 0: begins at x, 0.5: centred, 1: ends there; y is the base line.
  void Text(Vec2 at, const std::string& text, double size, double anchor = 0.0, bool bold = false);
  double TextWidth(const std::string& text, double size, bool bold = false);

  /// Writes the file; it appears complete or not at all. Throws Error when it cannot be written. Once.
  void Save();

 private:
  struct Closer {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };

  [[noreturn]] void ThrowCannotWrite(const std::string& reason);

  std::filesystem::path file_;
  std::filesystem::path part_;  ///< name until it is complete
  bool is_svg_;
  std::unique_ptr<cairo_surface_t, Closer> surface_;
  std::unique_ptr<cairo_t, Closer> context_;
};

/// "picture.png" or "picture.svg"? Throws Error if neither.
bool IsSvg(const std::filesystem::path& file);

}  // namespace nscdd
