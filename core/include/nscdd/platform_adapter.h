// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/contact_advance.h"
#include "nscdd/contact_table.h"
#include "nscdd/motion_view.h"

namespace nscdd {

/// Bodies and where they are: two columns, rows in ascending order of id.
struct PoseView {
  std::span<const std::int64_t> id;
  std::span<const Pose> pose;
};

/// What a finished step gives back to the platform.
struct StepResult {
  std::span<const std::int64_t> id;  ///< bodies that this rank owns, prescribed ones included, ascending
  std::span<const Pose> pose;        ///< at the end of the step
  std::span<const Twist> velocity;   ///< at the end of the step
  std::span<const ContactKey> key;   ///< contacts solved on this rank, ascending within each subdomain
  std::span<const Vec2> impulse;     ///< (r_n, r_t) of each [N s]
};

/// What an adapter is and can do. Constant during its life.
struct AdapterDescription {
  std::string name;                 ///< lower case, for messages and reports
  std::string version;              ///< of the platform behind it
  bool distributed_bodies = false;  ///< transport() is there: bodies can move between ranks
  bool prescribed_motion = false;   ///< kPrescribed bodies may have a velocity other than zero
  bool clusters = false;            ///< free bodies may have shapes away from their centre of mass (arms)
  double period = 0.0;              ///< length of the periodic direction x [m]; 0: not periodic
  double period_origin = 0.0;       ///< centres are kept in [period_origin, period_origin + period)
};

/// Moves bodies between the hosts of different ranks; shapes travel as bytes that the core never looks into.
class BodyTransport {
 public:
  virtual ~BodyTransport() = default;
  /// Appends to `bytes` all that Insert() on another rank needs to build the body: its id, shapes, state, loads and whatever
  /// else the host's user may have set. A body that changes its owner is packed anew, and replaces the ghost that the new
  /// owner's host had.
  virtual void Pack(std::int64_t id, std::vector<std::byte>* bytes) = 0;
  /// Builds the body from the bytes of Pack(). Throws Error if the id is there already or the bytes are not its own.
  virtual void Insert(std::int64_t id, std::span<const std::byte> bytes) = 0;
  /// Removes the body from this rank's host. Throws Error if it is not there.
  virtual void Remove(std::int64_t id) = 0;
};

/// The seam between the solver and a platform (a physics engine, a DEM code): who the bodies are, and which of them are
/// about to touch. SI units, double precision, radians, counter-clockwise positive.
///
/// The host owns the bodies between steps, the core owns the double-precision state during a step; only ids and rows cross.
/// One step calls ReadBodies, [transport()], SweepContacts (DetectContacts under a normal law of one stage) and Commit, in this
/// order; where bodies went elsewhere than they were expected to, transport() and SweepContacts again.
/// Every function throws Error with a sentence when it cannot do what is asked; the host is then unchanged.
class PlatformAdapter {
 public:
  virtual ~PlatformAdapter() = default;

  virtual AdapterDescription Describe() const = 0;

  /// Overwrites `bodies` with all bodies that this host holds, in any order. Edits that the host's user made since the last
  /// Commit (poses, velocities, loads, new and removed bodies) are in it.
  virtual void ReadBodies(BodyTable* bodies) = 0;

  /// Overwrites `contacts` with every pair of shapes of different bodies whose gap at the GIVEN poses is <= `alert` [m], that
  /// the host's filters let touch and of which one at least is kFree. `poses` names every body of this host. Sorted by key, no
  /// key twice, independent of history; the host is unchanged.
  virtual void DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) = 0;

  /// Overwrites `contacts` with every pair as above whose gap at the BEGINNING of the motion is <= the sum of both reaches,
  /// each with the moment at which the shapes first touch on their way: 0 if the gap is closed already (nscdd/sweep.h), and
  /// that at which they are closest if they do not touch. Gap, normal, levers and arms are those of this moment, the site is
  /// that of the beginning; so a wall is on the side that the disk starts from. What the motion of the two cannot reach before
  /// a neighbouring wall does (the hidden corner of two floor pieces that meet) is left out, if the neighbour is in the table.
  ///
  /// As it stands here, for adapters that do not know it: DetectContacts() at the beginning within the largest sum of reaches,
  /// and the moments of disks, corners and unbounded flat sides.
  virtual void SweepContacts(const MotionView& motion, ContactTable* contacts) {
    DetectContacts({motion.id, motion.pose}, LargestReach(motion), contacts);
    AdvanceToMeetings(motion, Describe().period, contacts);
  }

  /// Writes the end of the step into the host. The only function here that changes poses and velocities.
  virtual void Commit(const StepResult& result) = 0;

  /// Null unless Describe().distributed_bodies; owned by the adapter.
  virtual BodyTransport* transport() = 0;
};

}  // namespace nscdd
