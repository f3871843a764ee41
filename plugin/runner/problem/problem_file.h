// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "nscdd/contact_problem.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "scene/scene.h"

namespace nscdd {

/// The contact problem of one time step, and what a solver answered.
struct RecordedStep {
  BodyTable bodies;             ///< at the beginning of the step, ascending ids; rows of the problem
  ContactProblem problem;       ///< contacts by key, without those that the normal law does not see
  std::vector<Twist> velocity;  ///< V by row of bodies
  std::vector<Vec2> impulse;    ///< (r_n, r_t) by contact [N s]
};

/// Stands between a solver and an adapter, on one rank, and keeps what the last step read, found and committed: so the problem
/// that is looked at is the one that was solved.
class StepRecorder final : public PlatformAdapter {
 public:
  /// Keeps the pointer.
  explicit StepRecorder(PlatformAdapter* adapter) : adapter_(adapter) {}

  AdapterDescription Describe() const override;
  void ReadBodies(BodyTable* bodies) override;
  void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) override;
  void SweepContacts(const MotionView& motion, ContactTable* contacts) override;
  void Commit(const StepResult& result) override;
  BodyTransport* transport() override { return nullptr; }

  /// Of the last committed step, of length dt [s]. `stepping`: its normal law, which makes b_n. Throws Error when there was no
  /// step.
  RecordedStep Problem(const SteppingOptions& stepping, double dt) const;

 private:
  PlatformAdapter* adapter_;
  BodyTable bodies_;  // in ascending order of id
  ContactTable contacts_;
  std::vector<Twist> motion_;  // of the last sweep
  std::vector<Twist> velocity_;
  std::vector<ContactKey> key_;
  std::vector<Vec2> impulse_;
  bool committed_ = false;
};

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

/// Writes a contact problem with the answer of a solver in FCLib's HDF5 format (fclib.h of libfclib-dev): /fclib_global with M,
/// H, f, w, mu and /fclib_local with W, q, mu (nscdd/contact_operators.h says the order of rows and the signs; mu is per
/// contact, spacedim 2, matrices in compressed columns), and (v, u, r) as /solution if the solver converged, else as
/// /guesses/1. A file that is there is replaced by the complete new one. Throws Error when there is no contact and when the
/// file cannot be written.
void WriteFclibFile(const std::filesystem::path& path, const std::string& title, const std::string& description,
                    const ContactProblem& problem, const ContactSolution& answer);

}  // namespace nscdd
