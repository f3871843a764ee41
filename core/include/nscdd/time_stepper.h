// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/communicator.h"
#include "nscdd/contact_table.h"
#include "nscdd/options.h"
#include "nscdd/platform_adapter.h"
#include "nscdd/report.h"

namespace nscdd {

/// This rank's bodies after the last step, as a structure of arrays with one entry per body, ascending by id.
struct BodyResults {
  std::vector<std::int64_t> id;
  std::vector<BodyKind> kind;
  std::vector<double> radius;  ///< [m]
  std::vector<Pose> pose;      ///< at the end of the step
  std::vector<Twist> velocity;
  std::vector<std::int32_t> multiplicity;  ///< subdomains that hold a contact of it; 0: none
  std::vector<std::int32_t> subdomain;     ///< home cell of its centre

  std::size_t size() const { return id.size(); }
};

/// The candidate contacts that this rank solved in the last step, one entry per contact, ascending by (subdomain, key).
struct ContactResults {
  std::vector<ContactKey> key;
  std::vector<double> gap;        ///< [m] at the detection configuration
  std::vector<double> final_gap;  ///< [m] at the end of the step
  std::vector<Vec2> normal;
  std::vector<Vec2> point;              ///< [m] where the impulse acts, at the detection configuration
  std::vector<double> lever_a;          ///< [m] A's disk has its centre at point - lever_a n, B's at point + lever_b n;
  std::vector<double> lever_b;          ///< 0 for other shapes
  std::vector<Vec2> impulse;            ///< (r_n, r_t) [N s]
  std::vector<Vec2> relative_velocity;  ///< (v_n, v_t) [m/s] at the end of the step
  std::vector<ContactStatus> status;
  std::vector<std::int32_t> subdomain;

  std::size_t size() const { return key.size(); }
};

/// The whole time step of Moreau and Jean, over the ranks of `communicator`:
///     q_m = q_i + (1 - theta) dt V_i,  contacts at q_m,  V_f = V_i + dt M^-1 f,
///     V = V_f + M^-1 H r with v = H^T V in the contact law,  q_{i+1} = q_m + theta dt V.
/// Each rank has its own adapter, holding the bodies of its subdomains and ghosts; bodies migrate by the adapter's transport().
/// Before the first step every body is in exactly one rank's host. Between steps the host's user may add bodies on any rank,
/// and edit or remove a body on the rank that owns it (bodies() lists those): edits of ghosts are not read, removing one is an
/// Error. Shapes and materials of a body that has ghosts stay what they were when it got them; replace the body by one with a
/// new id. Reports and results are bitwise the same on any number of ranks. Not for concurrent use of one instance.
class TimeStepper {
 public:
  /// Keeps references to both. Throws Error, on all ranks, on impossible options, on more ranks than subdomains and when
  /// several ranks meet an adapter without transport.
  TimeStepper(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter,
              Communicator* communicator);
  ~TimeStepper();
  TimeStepper(TimeStepper&&) noexcept;

  /// One step of `dt` [s] > 0. Collective. Throws the same Error on all ranks when an adapter fails or breaks its contract; the
  /// hosts' poses and velocities are then unchanged (unless it was Commit() that failed on one rank), and once the cause is
  /// mended the step may be tried again.
  const StepReport& Step(double dt);

  /// What a continuation needs beside the hosts' bodies, this rank's part: step and time counters, cuts of the grid, impulses
  /// by key, interface impulses by (body, subdomain). Factorisations are not in it: none outlives a step.
  std::vector<std::byte> SaveState() const;
  /// Replaces them by the parts that the ranks of an earlier run saved at the same time, each given to one rank of this run;
  /// the number of ranks may be another one. On other subdomains the cuts are placed anew, and interface impulses are
  /// forgotten. The bodies are in the hosts, each in one, on any rank, and there are no ghosts. Collective; throws the same
  /// Error on all ranks, and changes nothing, if the bytes are not all those of SaveState().
  void LoadState(std::span<const std::span<const std::byte>> parts);
  /// On as many ranks as before, each with its own part.
  void LoadState(std::span<const std::byte> part);

  /// Of the last step, this rank's part. Valid until the next Step().
  const BodyResults& bodies() const;
  const ContactResults& contacts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nscdd
