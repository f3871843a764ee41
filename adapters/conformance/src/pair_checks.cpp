// SPDX-License-Identifier: Apache-2.0
// Which pairs of shapes are contacts: all of them, once, sorted, whatever happened before.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "check.h"
#include "contact_columns.h"
#include "scenes.h"

namespace nscdd::conformance {
namespace {

void PairsComplete(Trial* trial) {
  for (const double alert : {0.0, 0.0625, 0.5}) {
    Session session = trial->NewSession();
    AddRandomDisks(80, {-6.0, -6.0}, 14.0, &session, &trial->random);
    const BodyTable bodies = session.Read();
    const ContactTable contacts = session.Detect(bodies, alert);
    RequireAllPairs(bodies, contacts, alert);
    Require(contacts.size() > 20, "only {} contacts in a dense packing", contacts.size());
  }
}

/// Bodies creep towards each other by less than any margin at a time, and end in contact.
void PairsCompleteAfterDrift(Trial* trial) {
  for (const bool commits : {false, true}) {
    Session session = trial->NewSession();
    for (int i = 0; i < 16; ++i) {
      DiskSpec spec;
      spec.id = i;
      spec.centre = {1.5 * (i % 4), 1.5 * (i / 4)};
      session.host().AddDisk(spec);
    }
    BodyTable bodies = session.Read();
    const BodyTable start = bodies;
    std::size_t contacts = 0;
    for (int k = 1; k <= 240; ++k) {
      for (std::size_t row = 0; row < bodies.size(); ++row) {
        const double shrink = 1.0 - k / 512.0;
        bodies.pose[row].x = 2.25 + shrink * (start.pose[row].x - 2.25);
        bodies.pose[row].y = 2.25 + shrink * (start.pose[row].y - 2.25);
      }
      const ContactTable found = session.Detect(bodies, 0.015625);
      RequireAllPairs(bodies, found, 0.015625);
      contacts = found.size();
      if (commits) session.Commit(bodies);
    }
    Require(contacts == 24, "{} contacts at the end of the drift, not 24", contacts);
  }
}

void PairsSorted(Trial* trial) {
  Session session = trial->NewSession();
  AddRandomDisks(60, {0.0, 0.0}, 8.0, &session, &trial->random);
  const auto cluster = session.host().AddCluster({3, {{{2.0, 2.0}, 1.0}, {{3.0, 2.5}, 1.0}, {{3.5, 4.0}, 0.5}}});
  for (int i = 0; i < 2; ++i) {
    const BodyTable bodies = session.Read();
    const ContactTable contacts = session.Detect(bodies, 0.25);
    Require(contacts.size() > 20, "only {} contacts in a dense packing", contacts.size());
    for (std::size_t k = 1; k < contacts.size(); ++k) {
      const ContactKey before = KeyOf(contacts, bodies.id, k - 1), key = KeyOf(contacts, bodies.id, k);
      Require(before < key, "the key ({}, {}, {}, {}, {}) of contact {} is not above the one before it", key.body_a, key.body_b,
              key.shape_a, key.shape_b, key.image, k);
    }
    if (!cluster || i == 1) continue;
    const std::size_t row = RowOf(bodies, *cluster);
    std::set<std::int32_t> shapes;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      if (static_cast<std::size_t>(contacts.a[k]) == row) shapes.insert(contacts.shape_a[k]);
      if (static_cast<std::size_t>(contacts.b[k]) == row) shapes.insert(contacts.shape_b[k]);
    }
    Require(shapes.size() > 1, "all contacts of cluster {} have the same shape number", *cluster);
  }
}

void FiltersHonoured(Trial* trial) {
  Session session = trial->NewSession();
  DiskSpec spec;
  std::vector<std::int64_t> ids;
  for (int i = 0; i < 3; ++i) {
    spec.id = 2 + i;
    spec.centre = {0.9375 * i, 0.0};
    ids.push_back(session.host().AddDisk(spec));
  }
  RequireAllPairs(session.Read(), session.Detect(session.Read(), 0.0), 0.0);
  if (!session.host().NeverTouch(ids[0], ids[1])) throw CheckSkipped("the platform has no filters");
  const BodyTable bodies = session.Read();
  const ContactTable contacts = session.Detect(bodies, 0.0);
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactKey key = KeyOf(contacts, bodies.id, i);
    pairs.insert(std::minmax(key.body_a, key.body_b));
  }
  Require(!pairs.contains(std::minmax(ids[0], ids[1])), "bodies {} and {} touch against the host's filters", ids[0], ids[1]);
  Require(pairs.contains(std::minmax(ids[1], ids[2])), "bodies {} and {} do not touch, yet no filter parts them", ids[1],
          ids[2]);
}

/// A contact as seen from the body that was named first in the specs.
using LabelledContact = std::tuple<int, int, double, double, double, double, double, double, double>;

std::vector<LabelledContact> Labelled(const BodyTable& bodies, const ContactTable& c,
                                      const std::map<std::int64_t, int>& label) {
  std::vector<LabelledContact> all;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const int a = label.at(bodies.id[static_cast<std::size_t>(c.a[i])]),
              b = label.at(bodies.id[static_cast<std::size_t>(c.b[i])]);
    const double sign = a < b ? 1.0 : -1.0;
    const double lever_a = a < b ? c.lever_a[i] : c.lever_b[i], lever_b = a < b ? c.lever_b[i] : c.lever_a[i];
    all.emplace_back(std::min(a, b), std::max(a, b), c.gap[i], sign * c.normal[i].x, sign * c.normal[i].y, lever_a, lever_b,
                     c.site[i].x, c.site[i].y);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Adds the disks in this order and detects at their places, having been elsewhere before if `wanders`.
std::vector<LabelledContact> ReachedBy(const std::vector<DiskSpec>& specs, const std::vector<int>& order, bool wanders,
                                       Trial* trial) {
  Session session = trial->NewSession();
  std::map<std::int64_t, int> label;
  for (const int i : order) label[session.host().AddDisk(specs[static_cast<std::size_t>(i)])] = i;
  BodyTable bodies = session.Read();
  for (std::size_t row = 0; row < bodies.size(); ++row) bodies.velocity[row] = {};
  for (int k = 0; k < 6 && wanders; ++k) {
    BodyTable elsewhere = bodies;
    for (Pose& pose : elsewhere.pose) pose = {Uniform(-9.0, 9.0, &trial->random), Uniform(-9.0, 9.0, &trial->random), 1.0};
    session.Detect(elsewhere, 0.5);
    if (k % 2 == 1) session.Commit(elsewhere);
  }
  // Exactly the same numbers on any platform: the poses are given, not read.
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const DiskSpec& spec = specs[static_cast<std::size_t>(label.at(bodies.id[row]))];
    bodies.pose[row] = {spec.centre.x / 3.0, spec.centre.y / 3.0, 0.0};
  }
  return Labelled(bodies, session.Detect(bodies, 0.125), label);
}

void OrderFreeOfHistory(Trial* trial) {
  std::vector<DiskSpec> specs;
  {
    Session session = trial->NewSession();
    specs = AddRandomDisks(40, {-12.0, -12.0}, 24.0, &session, &trial->random);
  }
  std::vector<int> order;
  for (int i = 0; i < 40; ++i) order.push_back(i);
  const std::vector<LabelledContact> expected = ReachedBy(specs, order, false, trial);
  Require(expected.size() > 20, "only {} contacts in a dense packing", expected.size());
  Require(ReachedBy(specs, order, true, trial) == expected, "contacts depend on where the bodies were before");
  std::reverse(order.begin(), order.end());
  Require(ReachedBy(specs, order, false, trial) == expected, "contacts depend on the order in which bodies were added");
  std::shuffle(order.begin(), order.end(), trial->random);
  Require(ReachedBy(specs, order, true, trial) == expected, "contacts depend on what happened before");
}

/// What a broad phase with fat boxes does: keeps its list until a body moves by more than a margin in one call.
Fault StaleProximityList() {
  Fault fault;
  fault.name = "proximity list of fat boxes";
  std::vector<Pose> last;
  std::set<ContactKey> near;
  fault.detect = [last, near](PlatformAdapter* whole, const PoseView& poses, double alert, ContactTable* contacts) mutable {
    bool moved = last.size() != poses.pose.size();
    for (std::size_t i = 0; i < last.size() && !moved; ++i) moved = Norm(Centre(poses.pose[i]) - Centre(last[i])) > 0.05;
    whole->DetectContacts(poses, alert + (moved ? 0.05 : 0.0), contacts);
    if (moved) near.clear();
    for (std::size_t i = 0; moved && i < contacts->size(); ++i) near.insert(KeyOf(*contacts, poses.id, i));
    last.assign(poses.pose.begin(), poses.pose.end());
    for (std::size_t i = contacts->size(); i-- > 0;) {
      if (!near.contains(KeyOf(*contacts, poses.id, i)) || contacts->gap[i] > alert) EraseContact(i, contacts);
    }
  };
  return fault;
}

Fault IgnoresFilters() {
  return SpoilContacts("filters ignored", [](const PoseView& poses, ContactTable* contacts) {
    if (contacts->size() > 1) return;  // until a filter takes the first pair away
    RepeatLastContact(contacts);
    contacts->a[0] = 0;
    contacts->b[0] = static_cast<std::int32_t>(poses.id.size()) - 2;
  });
}

Fault RemembersCalls() {
  int calls = 0;
  return SpoilContacts("gaps that depend on earlier calls",
                       [calls](const PoseView&, ContactTable* contacts) mutable { contacts->gap[0] += 1e-15 * calls++; });
}

}  // namespace

std::vector<Check> PairChecks() {
  return {
      {"pairs_complete",
       "contacts are those of a double loop over all bodies",
       PairsComplete,
       {SpoilContacts("last pair lost", [](const PoseView&, ContactTable* c) { EraseContact(c->size() - 1, c); }),
        SpoilContacts("a pair too many", [](const PoseView&, ContactTable* c) { RepeatLastContact(c); })}},
      {"pairs_complete_after_drift",
       "no contact is missed after many moves below any margin",
       PairsCompleteAfterDrift,
       {StaleProximityList()}},
      {"pairs_sorted",
       "contacts are in ascending order of key, no key twice",
       PairsSorted,
       {SpoilContacts("two contacts swapped", [](const PoseView&, ContactTable* c) { SwapContacts(0, c->size() - 1, c); }),
        SpoilContacts("last contact twice", [](const PoseView&, ContactTable* c) { RepeatLastContact(c); })}},
      {"order_free_of_history", "the same poses give bitwise the same contacts", OrderFreeOfHistory, {RemembersCalls()}},
      {"filters_honoured", "what the host's filters part does not touch", FiltersHonoured, {IgnoresFilters()}},
  };
}

}  // namespace nscdd::conformance
