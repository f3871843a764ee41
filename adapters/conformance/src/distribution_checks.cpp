// SPDX-License-Identifier: Apache-2.0
// Bodies over several hosts, as over the ranks of a run, and periodic worlds.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "check.h"
#include "contact_columns.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

using ContactNumbers = std::tuple<double, double, double, double, double, double, double, double, double, double, double>;
using KeyedContacts = std::multimap<ContactKey, ContactNumbers>;

/// Those whose site lies in [x0, x1).
void Collect(const BodyTable& bodies, const ContactTable& c, double x0, double x1, KeyedContacts* all) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (c.site[i].x < x0 || c.site[i].x >= x1) continue;
    const Vec2 n = c.normal[i], s = c.site[i], arm_a = ArmA(c, i), arm_b = ArmB(c, i);
    all->emplace(KeyOf(c, bodies.id, i), ContactNumbers{c.gap[i], n.x, n.y, c.lever_a[i], c.lever_b[i], s.x, s.y,
                                                        arm_a.x + arm_a.y, arm_b.x + arm_b.y, c.friction[i], c.restitution[i]});
  }
}

void FillWorld(Session* session, std::mt19937_64* random) {
  AddRandomDisks(90, {-8.0, -4.0}, 16.0, session, random);
  if (session->adapter().Describe().clusters) session->host().AddCluster({1, {{{-0.375, 0.0}, 0.5}, {{0.375, 0.0}, 0.5}}});
  AddPolylineFloor(2, 0.25, session);
}

/// Whether the rank of [x0, x1) needs the body: walls everywhere; others if they may meet a contact whose site lies there.
bool Needs(const BodyTable& bodies, std::size_t row, double alert, double x0, double x1) {
  if (bodies.kind[row] == BodyKind::kPrescribed) return true;
  const double reach = 2.0 + bodies.bounding_radius[row] + alert;
  return bodies.pose[row].x + reach >= x0 && bodies.pose[row].x - reach < x1;
}

/// Exactly the needed bodies are here, with the numbers they had.
void RequireArrived(const BodyTable& all, const BodyTable& here, double alert, double x0, double x1) {
  for (std::size_t row = 0; row < all.size(); ++row) {
    const bool is_here = std::binary_search(here.id.begin(), here.id.end(), all.id[row]);
    Require(is_here == Needs(all, row, alert, x0, x1), "body {} was {} yet it is {}", all.id[row],
            is_here ? "removed" : "inserted", is_here ? "there" : "not there");
    if (!is_here) continue;
    const std::size_t mine = RowOf(here, all.id[row]);
    const Pose &p = all.pose[row], &q = here.pose[mine];
    const Twist &v = all.velocity[row], &w = here.velocity[mine];
    Require(p.x == q.x && p.y == q.y && p.angle == q.angle && v.vx == w.vx && v.vy == w.vy && v.spin == w.spin &&
                all.mass[row] == here.mass[mine] && all.inertia[row] == here.inertia[mine],
            "body {} changed on its way between two hosts", all.id[row]);
  }
}

void DistributedDetection(Trial* trial) {
  constexpr double kAlert = 0.125;
  Session whole = trial->NewSession();
  if (!whole.adapter().Describe().distributed_bodies) throw CheckSkipped("the adapter does not declare distributed bodies");
  FillWorld(&whole, &trial->random);
  BodyTable all = whole.Read();
  for (Pose& pose : all.pose) pose.x += pose.x / 3.0;  // committed doubles must travel as doubles
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (all.kind[row] == BodyKind::kFree) all.velocity[row] = {1.0 / 3.0, -0.1, 0.7};
  }
  whole.Commit(all);
  all = whole.Read();
  KeyedContacts expected, found;
  Collect(all, whole.Detect(all, kAlert), -1e300, 1e300, &expected);
  Require(expected.size() > 20, "only {} contacts in a dense packing", expected.size());

  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> cuts{-infinity, -4.0, 0.0, 5.0, infinity};
  for (std::size_t part = 0; part + 1 < cuts.size(); ++part) {
    const double x0 = cuts[part], x1 = cuts[part + 1];
    Session rank = trial->NewSession();
    std::vector<std::byte> bytes;
    for (std::size_t row = all.size(); row-- > 0;) {
      bytes.clear();
      whole.adapter().transport()->Pack(all.id[row], &bytes);
      rank.adapter().transport()->Insert(all.id[row], bytes);
    }
    for (std::size_t row = 0; row < all.size(); ++row) {
      if (!Needs(all, row, kAlert, x0, x1)) rank.adapter().transport()->Remove(all.id[row]);
    }
    const BodyTable here = rank.Read();
    RequireArrived(all, here, kAlert, x0, x1);
    Collect(here, rank.Detect(here, kAlert), x0, x1, &found);
  }
  for (const auto& [key, numbers] : expected) {
    Require(found.count(key) == 1, "the contact of bodies {} and {} is found {} times on all ranks together, not once",
            key.body_a, key.body_b, found.count(key));
    Require(found.find(key)->second == numbers, "the contact of bodies {} and {} has other numbers on its rank", key.body_a,
            key.body_b);
  }
  Require(found.size() == expected.size(), "the ranks find {} contacts, one host {}", found.size(), expected.size());
}

void PeriodicImages(Trial* trial) {
  constexpr double kPeriod = 8.0, kAlert = 0.125;
  Session session = trial->NewSession(kPeriod);
  const AdapterDescription description = session.adapter().Describe();
  Require(description.period == kPeriod && description.period_origin == 0.0,
          "the period is declared as {} from {}, not 8 from 0", description.period, description.period_origin);
  AddRandomDisks(100, {0.0, 0.0}, kPeriod, &session, &trial->random);
  BodyTable bodies = session.Read();
  for (Pose& pose : bodies.pose) pose.x += Uniform(-0.4, 0.4, &trial->random);  // half a drift leads out of the period
  const ContactTable contacts = session.Detect(bodies, kAlert);
  Require(contacts.has_images(), "contacts of a periodic world have no images");
  RequireAllPairs(bodies, contacts, kAlert, kPeriod);
  std::size_t across = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::size_t a = static_cast<std::size_t>(contacts.a[i]), b = static_cast<std::size_t>(contacts.b[i]);
    const double shift = contacts.image[i] * kPeriod;
    across += contacts.image[i] != 0 ? 1 : 0;
    Require(std::abs(contacts.gap[i] - DiskGap(bodies, a, b, shift)) <= 1e-12 * kPeriod,
            "the gap of bodies {} and {} (image {}) is {}: B is seen at x_B + image * period", bodies.id[a], bodies.id[b],
            contacts.image[i], contacts.gap[i]);
    const Vec2 d{bodies.pose[b].x + shift - bodies.pose[a].x, bodies.pose[b].y - bodies.pose[a].y};
    Require(Dot(d, contacts.normal[i]) > 0.0 || Norm(d) < 1e-9,
            "the normal of bodies {} and {} does not lead to the image of B", bodies.id[a], bodies.id[b]);
  }
  Require(across > 0, "no contact leads across the seam of a dense packing");
}

void BothImages(Trial* trial) {
  Session session = trial->NewSession(2.0);
  DiskSpec spec;
  spec.radius = 0.75;
  spec.id = session.host().AddDisk(spec);
  spec.id = 8;
  spec.centre = {1.0, 0.0};
  session.host().AddDisk(spec);
  const BodyTable bodies = session.Read();
  const ContactTable contacts = session.Detect(bodies, 0.0);
  Require(contacts.size() == 2, "two disks that touch to the left and to the right have {} contacts, not 2", contacts.size());
  Require(contacts.image[0] == -1 && contacts.image[1] == 0, "their images are {} and {}, not -1 and 0", contacts.image[0],
          contacts.image[1]);
}

Fault InsertsNothing() {
  Fault fault;
  fault.name = "Insert does nothing";
  fault.insert = [](BodyTransport*, std::int64_t, std::span<const std::byte>) {};
  return fault;
}

Fault RemovesNothing() {
  Fault fault;
  fault.name = "Remove does nothing";
  fault.remove = [](BodyTransport*, std::int64_t) {};
  return fault;
}

Fault SitesOfTheRank() {
  return SpoilContacts("sites that depend on what else is on the rank", [](const PoseView& poses, ContactTable* c) {
    for (Vec2& site : c->site) site.x += 0.25 * poses.pose[poses.pose.size() / 2].x;
  });
}

}  // namespace

std::vector<Check> DistributionChecks() {
  return {
      {"distributed_detection",
       "contacts of several hosts together are those of one",
       DistributedDetection,
       {InsertsNothing(), RemovesNothing(), SitesOfTheRank()}},
      {"periodic_images",
       "contacts across the seam are found, with their images",
       PeriodicImages,
       {SpoilContacts("images lost", [](const PoseView&, ContactTable* c) { c->image.assign(c->size(), 0); }),
        SpoilContacts("images reversed",
                      [](const PoseView&, ContactTable* c) {
                        for (std::int32_t& image : c->image) image = -image;
                      })}},
      {"both_images",
       "a pair that touches on both sides has two contacts",
       BothImages,
       {SpoilContacts("nearest image only", [](const PoseView&, ContactTable* c) { EraseContact(0, c); })}},
  };
}

}  // namespace nscdd::conformance
