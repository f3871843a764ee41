// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "nscdd/body_table.h"
#include "nscdd/reference/world.h"
#include "nscdd/vector.h"
#include "scene/free_ids.h"
#include "scene/generators.h"
#include "scene/gravity.h"

namespace nscdd {

/// What a scene calls it.
enum class BodyRole : std::uint8_t { kDisk = 0, kCluster = 1, kWall = 2 };

/// A body, complete, as platforms take it; the reference platform's description serves all of them.
struct BodyDefinition : reference::Body {
  BodyRole role = BodyRole::kDisk;
  int material = 0;  ///< index in Scene::materials, where friction and restitution are from
};

struct Material {
  std::string name;
  double density = 1.0;      ///< [kg/m^2]
  double friction = 0.3;     ///< [-] Coulomb coefficient; the platform combines the two of a pair
  double restitution = 0.0;  ///< [-] Newton coefficient
};

/// What a user should hear about input that is legal and yet perhaps not what was meant: whole sentences, each said once.
struct Notes {
  std::vector<std::string> sentences;
};

struct TimeSettings {
  double dt = 0.0;  ///< [s]
  std::int64_t steps = 0;
  double theta = 0.5;  ///< [-] the solver knows its limits
  int theta_line = 0;  ///< of the file; 0: not there
};

/// Bodies are periodic in x: centres live in [origin, origin + length).
struct Periodicity {
  double origin = 0.0;  ///< [m]
  double length = 0.0;  ///< [m]
};

/// One disk, written in the scene file.
struct SingleDisk {
  Pose pose;
  double radius = 0.0;  ///< [m]
};

/// Disks in a table; read row by row, never held.
struct DiskFile {
  std::filesystem::path path;
  bool has_ids = false;
  std::int64_t free = 0;    ///< disks that are free
  double free_radii = 0.0;  ///< [m] sum over them
};

/// The bodies of a state file, with their ids; read in blocks, never held.
struct StateBodies {
  std::filesystem::path path;
  std::uint64_t checksum = 0;  ///< of the file, to see it change
  double mean_radius = 0.0;    ///< [m] of its grains; 0: it has none
};

/// A rigid assembly of disks, at one or more places.
struct Cluster {
  std::vector<reference::Disk> disks;  ///< in the frame that `at` places
  std::vector<Pose> at;
  std::optional<double> mass;     ///< [kg] instead of the sum over the disks
  std::optional<double> inertia;  ///< [kg m^2] about the centre of mass, instead of the sum over the disks
};

/// A prescribed body made of any shapes, or one prescribed body for each of its disks.
struct Wall {
  std::vector<reference::Disk> disks;  ///< all shapes in the world frame, at the first step
  std::vector<reference::Segment> segments;
  std::vector<reference::HalfPlane> half_planes;
  Vec2 centre;           ///< [m] about which it spins
  bool one_body = true;  ///< false: every disk is a body of its own
};

/// What one entry of the scene file makes: `count` bodies that follow each other.
struct BodySource {
  std::string key;  ///< where it stands, such as "disks[2]"
  int line = 0;
  std::variant<StateBodies, SingleDisk, DiskFile, Lattice, Deposition, Cluster, Wall> what;
  std::int64_t count = 1;
  int material = 0;  ///< index in Scene::materials
  BodyKind kind = BodyKind::kFree;
  Twist velocity;
  std::optional<std::int64_t> id;  ///< of a single body
};

/// A key of [solver] that the solver itself will understand or refuse.
struct SolverOption {
  std::string key;
  std::string text;  ///< numbers in the shortest form that reads back the same, pairs as "2x3", flags as "true" or "false"
  int line = 0;
};

/// What solver "auto" is asked for; nothing: an interpenetration of 1e-3 mean radii.
struct AutoSettings {
  std::optional<double> interpenetration;  ///< largest that is fine, in mean radii or metres
  bool of_mean_radius = true;
  std::optional<double> budget;  ///< [s] a step
};

enum class OnNonconvergence { kContinue, kStop };

struct SceneSolver {
  std::string name = "nscd";
  int line = 0;  ///< of the name, or of the file's first line
  std::vector<SolverOption> options;
  std::optional<AutoSettings> wish;  ///< of the solver "auto"
  OnNonconvergence on_nonconvergence = OnNonconvergence::kContinue;
};

struct OutputSettings {
  std::string dir;                               ///< empty: the runner's default
  std::optional<std::int64_t> save_every;        ///< steps between two saved states; none: first and last only
  std::optional<std::int64_t> checkpoint_every;  ///< steps between two checkpoints; none: no checkpoints
  std::string packing;  ///< file in the output folder that receives the free disks at the end (packing.h)
};

/// The state file that a scene begins with.
struct StartState {
  std::filesystem::path path;
  RunClock clock;  ///< at the first step: the file's, or that of a new run
};

/// A scene file as read: settings and recipes of bodies, never the bodies themselves.
struct Scene {
  std::filesystem::path file;
  std::string name;
  std::string title;
  std::string adapter = "box2d";
  TimeSettings time;
  std::optional<StartState> start;
  GravityLaw gravity;
  std::optional<Periodicity> periodic;
  std::vector<Material> materials;  ///< never empty; the first is the default
  std::vector<BodySource> bodies;   ///< those of a state file first, then walls; clusters last
  FreeIds free_ids;                 ///< for bodies without an id of their own
  SceneSolver solver;
  OutputSettings output;
  Notes notes;  ///< on what was read

  /// Before the first step.
  RunClock clock() const { return start ? start->clock : RunClock{}; }
};

}  // namespace nscdd
