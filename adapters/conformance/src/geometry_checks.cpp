// SPDX-License-Identifier: Apache-2.0
// The numbers of a contact: gap, normal, levers, arms, site.
#include <algorithm>
#include <cmath>

#include "check.h"
#include "contact_columns.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

std::size_t RowA(const ContactTable& contacts, std::size_t i) { return static_cast<std::size_t>(contacts.a[i]); }
std::size_t RowB(const ContactTable& contacts, std::size_t i) { return static_cast<std::size_t>(contacts.b[i]); }

void GapInDouble(Trial* trial) {
  for (const double coordinate : {10.0, 1e3, 1e4}) {
    Session session = trial->NewSession();
    AddRandomDisks(60, {coordinate, -coordinate}, 9.0, &session, &trial->random);
    BodyTable bodies = session.Read();
    for (Pose& pose : bodies.pose) {
      pose.x += Uniform(-0.1, 0.1, &trial->random);
      pose.y += Uniform(-0.1, 0.1, &trial->random);
    }
    const ContactTable contacts = session.Detect(bodies, 0.125);
    Require(contacts.size() > 20, "only {} contacts in a dense packing near {}", contacts.size(), coordinate);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const std::size_t a = RowA(contacts, i), b = RowB(contacts, i);
      const double expected = DiskGap(bodies, a, b);
      Require(std::abs(contacts.gap[i] - expected) <= 1e-12 * coordinate,
              "the gap of bodies {} and {} near {} is {:.17g}, not {:.17g}: compute it from the given poses in double",
              bodies.id[a], bodies.id[b], coordinate, contacts.gap[i], expected);
    }
  }
}

void RequireUnit(Vec2 n, std::int64_t id_a, std::int64_t id_b) {
  Require(std::abs(Norm(n) - 1.0) <= 1e-14, "the normal ({}, {}) of bodies {} and {} is not a unit vector", n.x, n.y, id_a,
          id_b);
}

void FrameFromAToB(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(60, {-5.0, -5.0}, 10.0, &session, &trial->random);
  const BodyTable bodies = session.Read();
  const ContactTable contacts = session.Detect(bodies, 0.125);
  Require(contacts.size() > 20, "only {} contacts in a dense packing", contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::size_t a = RowA(contacts, i), b = RowB(contacts, i);
    const Vec2 n = contacts.normal[i], d = Centre(bodies.pose[b]) - Centre(bodies.pose[a]);
    RequireUnit(n, bodies.id[a], bodies.id[b]);
    Require(Norm(d) < 1e-9 || Norm(d - Norm(d) * n) <= 1e-12, "the normal ({}, {}) does not lead from body {} to body {}", n.x,
            n.y, bodies.id[a], bodies.id[b]);
  }
}

void CoincidentCentres(Trial* trial) {
  Session session = trial->NewSession();
  DiskSpec spec;
  spec.id = 1;
  session.host().AddDisk(spec);
  spec.id = 2;
  spec.radius = 0.25;
  session.host().AddDisk(spec);
  BodyTable bodies = session.Read();
  bodies.pose[0] = bodies.pose[1] = {1.0 / 3.0, 2.0 / 3.0, 0.0};
  const ContactTable contacts = session.Detect(bodies, 0.0);
  Require(contacts.size() == 1, "two disks with one centre have {} contacts, not 1", contacts.size());
  RequireUnit(contacts.normal[0], bodies.id[0], bodies.id[1]);
  Require(contacts.gap[0] == -0.75, "two disks of radii 0.5 and 0.25 with one centre have the gap {}, not -0.75",
          contacts.gap[0]);
}

/// One disk of radius 1/2 on a floor, at several heights, the floor's id below and above the disk's.
bool CheckFloor(AddFloor add_floor, Trial* trial) {
  for (const std::int64_t floor_id : {3, 30}) {
    Session session = trial->NewSession();
    DiskSpec spec;
    spec.id = 10;
    spec.centre = {0.0, 4.0};
    const std::int64_t disk_id = session.host().AddDisk(spec);
    const auto floor = add_floor(floor_id, 0.5, &session);
    if (!floor) return false;
    BodyTable bodies = session.Read();
    const std::size_t disk = RowOf(bodies, disk_id), wall = RowOf(bodies, *floor);
    Require(bodies.kind[wall] == BodyKind::kPrescribed, "wall {} is not prescribed", *floor);
    for (const double x : {0.75, -2.0, -1.9999999}) {  // the second is where two segments of the polyline meet
      for (const double gap : {0.0, 0.0625, -0.03125, 0.001}) {
        bodies.pose[disk] = {x, 0.5 + gap, 1.0};
        const ContactTable contacts = session.Detect(bodies, 0.125);
        Require(contacts.size() == 1, "a disk at ({}, {}) of radius 0.5 has {} contacts with the floor y = 0, not 1", x,
                0.5 + gap, contacts.size());
        const double sign = wall < disk ? 1.0 : -1.0;
        Require(std::abs(contacts.gap[0] - gap) <= 1e-13,
                "the gap of a disk on wall {} is {:.17g}, not {:.17g}: walls have no skin", *floor, contacts.gap[0], gap);
        Require(Norm(contacts.normal[0] - Vec2{0.0, sign}) <= 1e-13, "the normal on wall {} is ({}, {}), not (0, {})", *floor,
                contacts.normal[0].x, contacts.normal[0].y, sign);
        Require(x == -2.0 || contacts.flat[0] == 1, "a disk inside of wall {} touches it, yet flat is 0", *floor);
      }
    }
  }
  return true;
}

void WallSkinZero(Trial* trial) {
  const bool half_plane = CheckFloor(AddHalfPlaneFloor, trial);
  const bool polyline = CheckFloor(AddPolylineFloor, trial);
  if (!half_plane && !polyline) throw CheckSkipped("the platform has no walls but disks");
}

/// Where the impulse acts, seen from A and from B, must be one point (the pair has no net moment).
void RequirePoint(const BodyTable& bodies, const ContactTable& c, std::size_t i) {
  const std::size_t a = RowA(c, i), b = RowB(c, i);
  const double scale = CoordinateScale(bodies);
  const Vec2 from_a = Centre(bodies.pose[a]) + ArmA(c, i) + c.lever_a[i] * c.normal[i];
  const Vec2 from_b = Centre(bodies.pose[b]) + ArmB(c, i) - c.lever_b[i] * c.normal[i];
  Require(Norm(from_a - from_b) <= 1e-12 * scale,
          "arms and levers of bodies {} and {} lead to ({}, {}) from A and to ({}, {}) from B: one point is asked for",
          bodies.id[a], bodies.id[b], from_a.x, from_a.y, from_b.x, from_b.y);
}

void RequireSite(const BodyTable& bodies, const ContactTable& c, std::size_t i, Vec2 expected) {
  Require(Norm(c.site[i] - expected) <= 1e-12 * CoordinateScale(bodies),
          "the site of bodies {} and {} is ({}, {}), not ({}, {})", bodies.id[RowA(c, i)], bodies.id[RowB(c, i)], c.site[i].x,
          c.site[i].y, expected.x, expected.y);
}

void LeversOfDisks(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(60, {5.0, -5.0}, 9.0, &session, &trial->random);
  const BodyTable bodies = session.Read();
  const ContactTable c = session.Detect(bodies, 0.25);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const std::size_t a = RowA(c, i), b = RowB(c, i);
    Require(std::abs(c.lever_a[i] - (bodies.radius[a] + 0.5 * c.gap[i])) <= 1e-12 &&
                std::abs(c.lever_b[i] - (bodies.radius[b] + 0.5 * c.gap[i])) <= 1e-12,
            "the levers {} and {} of bodies {} and {} are not radius + gap / 2", c.lever_a[i], c.lever_b[i], bodies.id[a],
            bodies.id[b]);
    RequirePoint(bodies, c, i);
    RequireSite(bodies, c, i, 0.5 * (Centre(bodies.pose[a]) + Centre(bodies.pose[b])));
  }
}

void LeversOnFloor(AddFloor add_floor, Trial* trial) {
  for (const std::int64_t floor_id : {3, 30}) {
    Session session = trial->NewSession();
    DiskSpec spec;
    spec.id = 10;
    const std::int64_t disk_id = session.host().AddDisk(spec);
    const auto floor = add_floor(floor_id, 0.5, &session);
    if (!floor) return;
    BodyTable bodies = session.Read();
    const std::size_t disk = RowOf(bodies, disk_id), wall = RowOf(bodies, *floor);
    bodies.pose[disk] = {0.75, 0.5625, 2.0};
    const ContactTable c = session.Detect(bodies, 0.125);
    Require(c.size() == 1, "a disk on wall {} has {} contacts, not 1", *floor, c.size());
    const bool wall_is_a = wall < disk;
    const double of_wall = wall_is_a ? c.lever_a[0] : c.lever_b[0], of_disk = wall_is_a ? c.lever_b[0] : c.lever_a[0];
    Require(std::abs(of_wall) <= 1e-13 && std::abs(of_disk - 0.5625) <= 1e-13,
            "on wall {} the levers are {} (wall) and {} (disk), not 0 and radius + gap = 0.5625", *floor, of_wall, of_disk);
    RequirePoint(bodies, c, 0);
    RequireSite(bodies, c, 0, {0.75, 0.0});
  }
}

void LeversOfClusters(Trial* trial) {
  Session session = trial->NewSession();
  if (!session.adapter().Describe().clusters) return;
  ClusterSpec spec;  // symmetric: its centre of mass is exactly (0, 0)
  spec.id = 5;
  spec.disks = {{{-0.375, 0.0}, 0.5}, {{0.375, 0.0}, 0.5}};
  const auto id = session.host().AddCluster(spec);
  Require(id.has_value(), "the adapter declares clusters, yet the host adds none");
  AddRandomDisks(80, {-5.0, -5.0}, 10.0, &session, &trial->random);
  BodyTable bodies = session.Read();
  const std::size_t row = RowOf(bodies, *id);
  bodies.pose[row].angle = 0.75;
  const ContactTable c = session.Detect(bodies, 0.25);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const bool is_a = RowA(c, i) == row;
    if (!is_a && RowB(c, i) != row) continue;
    ++touching;
    const Vec2 arm = is_a ? ArmA(c, i) : ArmB(c, i);
    const double lever = is_a ? c.lever_a[i] : c.lever_b[i], precision = 1e-12 + 8.0 * session.host().precision();
    const Vec2 member = Rotate(0.75, {0.375, 0.0});
    Require(
        std::min(Norm(arm - member), Norm(arm + member)) <= precision && std::abs(lever - 0.5 - 0.5 * c.gap[i]) <= precision,
        "cluster {} has the arm ({}, {}) and the lever {}: no disk of it is there", *id, arm.x, arm.y, lever);
    RequirePoint(bodies, c, i);
    RequireSite(bodies, c, i,
                0.5 * (Centre(bodies.pose[RowA(c, i)]) + ArmA(c, i) + Centre(bodies.pose[RowB(c, i)]) + ArmB(c, i)));
  }
  Require(touching > 0, "cluster {} in the middle of a packing has no contact", *id);
}

void LeversAndArms(Trial* trial) {
  LeversOfDisks(trial);
  LeversOnFloor(AddHalfPlaneFloor, trial);
  LeversOnFloor(AddPolylineFloor, trial);
  LeversOfClusters(trial);
}

Fault FloatPoses() {
  Fault fault;
  fault.name = "gaps of float poses";
  fault.detect = [](PlatformAdapter* whole, const PoseView& poses, double alert, ContactTable* contacts) {
    std::vector<Pose> rounded;
    for (const Pose& q : poses.pose) rounded.push_back({static_cast<float>(q.x), static_cast<float>(q.y), q.angle});
    whole->DetectContacts({poses.id, rounded}, alert, contacts);
  };
  return fault;
}

Fault WallsWithSkin() {
  return SpoilContacts("walls with a skin of 0.01 m", [](const PoseView&, ContactTable* c) {
    for (std::size_t i = 0; i < c->size(); ++i) c->gap[i] -= c->flat[i] != 0 ? 0.01 : 0.0;
  });
}

}  // namespace

std::vector<Check> GeometryChecks() {
  return {
      {"gap_in_double", "gaps are exact to 1e-12 of the coordinates, near 10, 1e3 and 1e4", GapInDouble, {FloatPoses()}},
      {"frame_from_a_to_b",
       "normals are unit vectors from A to B",
       FrameFromAToB,
       {SpoilContacts("a normal reversed", [](const PoseView&, ContactTable* c) { c->normal[0] = -1.0 * c->normal[0]; }),
        SpoilContacts("a normal too long", [](const PoseView&, ContactTable* c) { c->normal[0] = 1.000001 * c->normal[0]; })}},
      {"coincident_centres",
       "disks with one centre have a normal",
       CoincidentCentres,
       {SpoilContacts("0 / 0",
                      [](const PoseView&, ContactTable* c) {
                        c->normal[0] = {std::nan(""), std::nan("")};
                      })}},
      {"wall_skin_zero",
       "walls are where they were put, and joints of a polyline do not show",
       WallSkinZero,
       {WallsWithSkin()}},
      {"levers_and_arms",
       "levers, arms and sites are those of contact_table.h",
       LeversAndArms,
       {SpoilContacts("levers without the gap", [](const PoseView&, ContactTable* c) { c->lever_a[0] -= 0.5 * c->gap[0]; }),
        SpoilContacts("site at the surface of A",
                      [](const PoseView&, ContactTable* c) { c->site[0] = c->site[0] - c->lever_b[0] * c->normal[0]; })}},
  };
}

}  // namespace nscdd::conformance
