// SPDX-License-Identifier: Apache-2.0
// Contacts on the bodies' way through a step: who is within reach, and when shapes meet.
#include <algorithm>
#include <cmath>
#include <set>

#include "check.h"
#include "contact_columns.h"
#include "nscdd/contact_kinematics.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

constexpr double kStep = 1.0 / 64.0;  // [s]

/// A motion of all bodies of a session; prescribed ones move if the platform lets them.
struct Motion {
  BodyTable bodies;
  std::vector<Twist> velocity;
  std::vector<double> reach;

  MotionView view() const { return {bodies.id, bodies.pose, velocity, reach, kStep}; }
  Vec2 At(std::size_t row, double t) const { return Centre(Moved(bodies.pose[row], velocity[row], t * kStep)); }
};

/// Up to `advance` [m] in the step, at random; reach is what a body comes, and up to a quarter more.
Motion RandomMotion(double advance, Session* session, std::mt19937_64* random) {
  Motion motion;
  motion.bodies = session->Read();
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const double speed = Uniform(0.0, advance, random) / kStep, angle = Uniform(-3.2, 3.2, random);
    motion.velocity.push_back({speed * std::cos(angle), speed * std::sin(angle), Uniform(-1.0, 1.0, random) / kStep});
    motion.reach.push_back(0.0625 + 1.25 * speed * kStep);
  }
  return motion;
}

ContactTable Sweep(const Motion& motion, Session* session) {
  ContactTable contacts;
  session->adapter().SweepContacts(motion.view(), &contacts);
  const std::size_t n = contacts.size();
  Require(!contacts.has_moments() || contacts.moment.size() == n, "SweepContacts gave {} contacts and {} moments", n,
          contacts.moment.size());
  for (std::size_t i = 0; i < n; ++i) {
    Require(contacts.MomentOf(i) >= 0.0 && contacts.MomentOf(i) <= 1.0, "contact {} has the moment {}, outside [0, 1]", i,
            contacts.MomentOf(i));
  }
  return contacts;
}

void SweepPairs(Trial* trial) {
  for (const double advance : {0.0, 0.5, 8.0}) {
    Session session = trial->NewSession();
    AddRandomDisks(80, {-9.0, -9.0}, 20.0, &session, &trial->random);
    const Motion motion = RandomMotion(advance, &session, &trial->random);
    const BodyTable& bodies = motion.bodies;
    const ContactTable contacts = Sweep(motion, &session);
    RequireUnchanged(bodies, session.Read(), "SweepContacts");
    std::set<ContactKey> found;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactKey key = KeyOf(contacts, bodies.id, i);
      Require(found.empty() || *found.rbegin() < key, "the contact of bodies {} and {} is not above the one before it",
              key.body_a, key.body_b);
      found.insert(key);
    }
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      for (std::size_t b = a + 1; b < bodies.size(); ++b) {
        const bool is_free = bodies.kind[a] == BodyKind::kFree || bodies.kind[b] == BodyKind::kFree;
        const double gap = DiskGap(bodies, a, b), reach = motion.reach[a] + motion.reach[b];
        const auto key = found.lower_bound({bodies.id[a], bodies.id[b], INT32_MIN, INT32_MIN, INT32_MIN});
        const bool is_there = key != found.end() && key->body_a == bodies.id[a] && key->body_b == bodies.id[b];
        Require(is_there || !is_free || gap > reach - 1e-12,
                "bodies {} and {} have the gap {} at the beginning, may come {} and have no contact", bodies.id[a],
                bodies.id[b], gap, reach);
        Require(!is_there || gap <= reach + 1e-12, "bodies {} and {} have a contact at the gap {}, beyond their reaches of {}",
                bodies.id[a], bodies.id[b], gap, reach);
      }
    }
  }
}

/// Row `c` must be the contact of two whole disks at its moment, the first at which they touch or that at which they are
/// closest.
void RequireMeeting(const Motion& motion, const ContactTable& c, std::size_t i) {
  const auto a = static_cast<std::size_t>(c.a[i]), b = static_cast<std::size_t>(c.b[i]);
  const double radii = motion.bodies.radius[a] + motion.bodies.radius[b], moment = c.MomentOf(i);
  const auto gap = [&](double t) { return Norm(motion.At(b, t) - motion.At(a, t)) - radii; };
  const std::int64_t id_a = motion.bodies.id[a], id_b = motion.bodies.id[b];
  Require(std::abs(c.gap[i] - gap(moment)) <= 1e-9 * radii, "the gap of bodies {} and {} is {}, at their moment {} it is {}",
          id_a, id_b, c.gap[i], moment, gap(moment));
  const Vec2 d = motion.At(b, moment) - motion.At(a, moment);
  Require(Norm(d - Norm(d) * c.normal[i]) <= 1e-9 * radii, "the normal of bodies {} and {} is not that of their moment {}",
          id_a, id_b, moment);
  Require(c.site.empty() || Norm(c.site[i] - 0.5 * (motion.At(a, 0.0) + motion.At(b, 0.0))) <= 1e-9 * radii,
          "the site of bodies {} and {} is not that of the beginning of the step", id_a, id_b);
  if (gap(0.0) <= 1e-9 * radii) {
    Require(moment == 0.0, "bodies {} and {} touch at the beginning, yet meet at {}", id_a, id_b, moment);
    return;
  }
  const bool touches = c.gap[i] <= 1e-8 * radii;
  for (int k = 0; k <= 512; ++k) {
    const double t = k / 512.0;
    Require(touches ? t >= moment || gap(t) >= -1e-8 * radii : gap(t) >= c.gap[i] - 1e-9 * radii,
            "bodies {} and {} have the gap {} at {}, {} the moment {} of their contact", id_a, id_b, gap(t), t,
            touches ? "before" : "less than at", moment);
  }
  // The half-plane: gap + dt w_n over the whole step is negative if and only if the way touches.
  const double w = RelativeVelocity(KinematicsOf(c, i), motion.velocity[a], motion.velocity[b]).x;
  const double end = c.gap[i] + (1.0 - moment) * kStep * w;
  Require(touches ? end <= 1e-8 * radii : end >= -1e-8 * radii,
          "the half-plane of bodies {} and {} leaves {} m at the end of a way that {}", id_a, id_b, end,
          touches ? "touches" : "does not touch");
}

void SweepMeetings(Trial* trial) {
  std::size_t touching = 0, passing = 0;
  for (const double advance : {0.25, 2.0, 8.0}) {
    Session session = trial->NewSession();
    AddRandomDisks(60, {-9.0, -9.0}, 20.0, &session, &trial->random);
    const Motion motion = RandomMotion(advance, &session, &trial->random);
    const ContactTable contacts = Sweep(motion, &session);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      RequireMeeting(motion, contacts, i);
      (contacts.gap[i] > 1e-6 ? passing : touching) += contacts.MomentOf(i) > 0.0;
    }
  }
  Require(touching > 20 && passing > 20, "{} contacts touch on their way and {} pass", touching, passing);
}

/// A disk that starts above a floor and would go through it must meet it from above.
void SweepWalls(Trial* trial) {
  int floors = 0;
  for (AddFloor add_floor : {AddHalfPlaneFloor, AddPolylineFloor}) {
    Session session = trial->NewSession();
    DiskSpec spec;
    spec.id = 10;
    spec.centre = {0.5, 2.0};
    const std::int64_t id = session.host().AddDisk(spec);
    const auto floor = add_floor(3, 0.0, &session);
    if (!floor) continue;
    ++floors;
    Motion motion;
    motion.bodies = session.Read();
    const std::size_t disk = RowOf(motion.bodies, id);
    motion.velocity.resize(motion.bodies.size());
    motion.reach.assign(motion.bodies.size(), 0.0);
    motion.velocity[disk] = {1.0 / kStep, -8.0 / kStep, 0.0};
    motion.reach[disk] = 8.25;
    const ContactTable c = Sweep(motion, &session);
    Require(c.size() == 1, "a disk on its way through the floor has {} contacts, not 1", c.size());
    Require(std::abs(c.MomentOf(0) - 1.5 / 8.0) <= 1e-9 && std::abs(c.gap[0]) <= 1e-9,
            "a disk that falls by 8 m from 1.5 m above floor {} meets it at {} with the gap {}, not at 0.1875", *floor,
            c.MomentOf(0), c.gap[0]);
    const double sign = c.a[0] == static_cast<std::int32_t>(disk) ? -1.0 : 1.0;
    Require(std::abs(c.normal[0].y - sign) <= 1e-9, "the normal of floor {} is ({}, {}): the disk comes from above", *floor,
            c.normal[0].x, c.normal[0].y);
  }
  if (floors == 0) throw CheckSkipped("the platform has no walls but disks");
}

Fault SpoilSweep(std::string name, std::function<void(const MotionView&, ContactTable*)> spoil) {
  Fault fault;
  fault.name = std::move(name);
  fault.sweep = [spoil = std::move(spoil)](PlatformAdapter* whole, const MotionView& motion, ContactTable* contacts) {
    whole->SweepContacts(motion, contacts);
    spoil(motion, contacts);
  };
  return fault;
}

/// Finds contacts for these reaches, or on this way, instead.
Fault OtherMotion(std::string name, std::function<void(Motion*)> change) {
  Fault fault;
  fault.name = std::move(name);
  fault.sweep = [change = std::move(change)](PlatformAdapter* whole, const MotionView& motion, ContactTable* contacts) {
    Motion other;
    other.velocity.assign(motion.velocity.begin(), motion.velocity.end());
    other.reach.assign(motion.reach.begin(), motion.reach.end());
    change(&other);
    whole->SweepContacts({motion.id, motion.pose, other.velocity, other.reach, motion.dt}, contacts);
  };
  return fault;
}

void StandStill(Motion* motion) { motion->velocity.assign(motion->velocity.size(), {}); }

}  // namespace

std::vector<Check> SweepChecks() {
  return {
      {"sweep_pairs",
       "contacts on the way are those within both bodies' reaches at the beginning",
       SweepPairs,
       {OtherMotion("reaches shortened", [](Motion* m) { std::ranges::for_each(m->reach, [](double& r) { r *= 0.5; }); }),
        OtherMotion("the largest reach for all",
                    [](Motion* m) { m->reach.assign(m->reach.size(), *std::max_element(m->reach.begin(), m->reach.end())); })}},
      {"sweep_meetings",
       "each is taken where its shapes first touch on their way, or are closest",
       SweepMeetings,
       {OtherMotion("bodies that stand still", StandStill),
        SpoilSweep("moments lost", [](const MotionView&, ContactTable* c) { c->moment.assign(c->size(), 0.0); }),
        OtherMotion("bodies that come half as far",
                    [](Motion* m) {
                      for (Twist& v : m->velocity) v = {0.5 * v.vx, 0.5 * v.vy, 0.5 * v.spin};
                    })}},
      {"sweep_walls",
       "a disk meets a wall on the side from which it comes",
       SweepWalls,
       {OtherMotion("bodies that stand still", StandStill), SpoilSweep("the other side",
                                                                       [](const MotionView&, ContactTable* c) {
                                                                         for (Vec2& n : c->normal) n = -1.0 * n;
                                                                       })}},
  };
}

}  // namespace nscdd::conformance
