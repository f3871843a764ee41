// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

#include "nscdd/contact_problem.h"
#include "problem/step_recorder.h"
#include "scene/notes.h"

namespace nscdd {

/// One contact problem from a JSON file; contacts keep their order.
///
/// Keys (SI units): `dt`, `theta` (default 0.5), `gravity` [gx, gy], `mu` (one number, or one per contact),
///   `bodies`   rows x y th vx vy w r m I fixed (state at the beginning of the step),
///   `planes`   rows nx ny d: the half-plane n.x >= d is free,
///   `contacts` rows i j nx ny gap l_i l_j b_n [...]: the normal leads from j to i, j < 0 names plane -1 - j; what follows in a
///              row (a stored solution, say) is not read,
///   and if wanted: `forces`, rows fx fy torque of each body beside gravity; `arms`, rows jx jy ix iy of each contact, of the
///   bodies that are no centred disks; `sites`, rows x y of each contact, which place it in a subdomain. Other keys are not
///   read; one that looks like a misspelt one of these is refused.
/// Normals with a few digits, off unit length by up to 1e-3, are normalised, and a note says so.
/// In the problem body A of a contact is j and body B is i; planes are prescribed bodies behind the others.
struct ProblemFile {
  ContactProblem problem;
  std::size_t body_count = 0;  ///< of the file, without the planes
  double theta = 0.5;
  Notes notes;  ///< on what was mended when reading
};

/// Throws Error, naming file and key, when the file cannot be read or its numbers make no problem.
ProblemFile ReadProblemFile(const std::filesystem::path& path);

/// Writes a step's problem so that it reads back the same. Throws Error when the file cannot be written.
void WriteProblemFile(const std::filesystem::path& path, const RecordedStep& step, double dt, double theta);

}  // namespace nscdd
