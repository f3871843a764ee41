// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace nscdd {

/// What a picture shows.
enum class Show {
  kGrains,        ///< coloured by speed, with a tick that shows their angle
  kForces,        ///< force chains: a line across each active contact, its width by the normal impulse
  kMultiplicity,  ///< bodies of several subdomains coloured by their number
  kOverlap,       ///< contacts that overlap by at least 0.9 of the largest overlap, in red
};

/// "grains", "forces", "multiplicity" or "overlap"; throws Error on anything else.
Show ParseShow(std::string_view word);
std::string_view ShowName(Show show);

struct RenderRequest {
  std::filesystem::path folder;      ///< results of `nscdd run`
  std::optional<std::int64_t> step;  ///< default: the last one saved
  Show show = Show::kGrains;
  std::filesystem::path output;  ///< .png or .svg; default: FOLDER/SHOW_STEP.png
};

struct RenderedPicture {
  std::filesystem::path file;
  std::int64_t step = 0;
  int width = 0;  ///< pixels (points, in SVG)
  int height = 0;
};

/// Draws a saved step. The file appears complete or not at all.
/// Throws Error when results are missing or have no such step (naming those there are), or the picture cannot be written.
RenderedPicture Render(const RenderRequest& request);

}  // namespace nscdd
