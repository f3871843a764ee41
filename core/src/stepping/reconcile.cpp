// SPDX-License-Identifier: Apache-2.0
#include "stepping/reconcile.h"

#include <algorithm>
#include <map>
#include <utility>

#include "parallel/bytes.h"
#include "problem/state.h"

namespace nscdd {
namespace {

/// A copy's end of the step on its way to the owner of the body.
struct CopyRecord {
  std::int64_t body;
  std::int32_t subdomain;
  double velocity[3];
};

/// Copies whose owner does not know V yet: all but those of its own bodies that no other subdomain touches.
std::vector<CopyRecord> CopiesOf(const PartitionedProblem& problem, const PartitionedState& state, const Population& population,
                                 const Sharing& sharing, int rank) {
  const int dofs = Dofs(problem.model);
  std::vector<CopyRecord> records;
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    const SubdomainProblem& p = problem.subdomains[e];
    for (std::size_t b = 0; b < p.body_count(); ++b) {
      const int m = sharing.Multiplicity(p.body[b]);
      if (m == 0 || (m == 1 && population.owner[p.body[b]] == rank)) continue;  // 0: prescribed
      CopyRecord record{(*problem.body_id)[p.body[b]], p.subdomain, {}};
      std::copy_n(&state.subdomains[e].velocity[dofs * b], dofs, record.velocity);
      records.push_back(record);
    }
  }
  return records;
}

void AddInterfaceImpulses(const PartitionedProblem& problem, const PartitionedState& state, ImpulseCache* cache) {
  const int dofs = Dofs(problem.model);
  for (std::size_t k = 0; k < problem.interface.copies.size(); ++k) {
    const auto& copy = problem.interface.copies[k];
    const SubdomainProblem& p = problem.subdomains[copy.problem];
    CachedInterfaceImpulse entry{(*problem.body_id)[p.body[copy.body]], p.subdomain, {}};
    std::copy_n(&state.interface.impulse[dofs * k], dofs, entry.force);
    cache->interfaces.push_back(entry);
  }
}

/// In the order of the table, which is that of the keys.
void AddContactImpulses(const ContactTable& table, const BodyTable& bodies, const std::vector<Vec2>& impulse,
                        ImpulseCache* cache) {
  for (std::size_t c = 0; c < impulse.size(); ++c) {
    if (impulse[c].x == 0.0 && impulse[c].y == 0.0) continue;
    const std::int32_t carrier = bodies.kind[table.a[c]] == BodyKind::kFree ? table.a[c] : table.b[c];
    cache->contacts.push_back({bodies.id[carrier], KeyOf(table, c, bodies.id), impulse[c]});
  }
}

/// Entries of bodies that others own go to their owners; what others send is appended.
void Exchange(const Population& population, Communicator* communicator, std::vector<CopyRecord>* copies, ImpulseCache* cache) {
  const int me = communicator->rank();
  const auto owner = [&](std::int64_t id) { return population.owner[population.RowOf(id)]; };
  // Copies and impulses of a body travel together, to its owner.
  struct Parcel {
    std::vector<CopyRecord> copies;
    ImpulseCache cache;
  };
  std::map<int, Parcel> parcels;
  const auto divert = [&](auto* list, auto id_of, auto member) {
    std::erase_if(*list, [&](const auto& entry) {
      const int rank = owner(id_of(entry));
      if (rank != me) member(&parcels[rank])->push_back(entry);
      return rank != me;
    });
  };
  divert(
      copies, [](const auto& e) { return e.body; }, [](Parcel* p) { return &p->copies; });
  divert(
      &cache->contacts, [](const auto& e) { return e.carrier; }, [](Parcel* p) { return &p->cache.contacts; });
  divert(
      &cache->interfaces, [](const auto& e) { return e.body; }, [](Parcel* p) { return &p->cache.interfaces; });

  // One message per rank; most ranks get none.
  std::vector<Message> outgoing;
  for (const auto& [rank, parcel] : parcels) {
    Message message{rank, {}};
    ByteWriter out(&message.bytes);
    out.PutSpan(std::span<const CopyRecord>(parcel.copies));
    out.PutSpan(std::span<const CachedImpulse>(parcel.cache.contacts));
    out.PutSpan(std::span<const CachedInterfaceImpulse>(parcel.cache.interfaces));
    outgoing.push_back(std::move(message));
  }
  for (const Message& message : communicator->Deliver(std::move(outgoing))) {
    ByteReader in(message.bytes);
    const auto more = in.GetVector<CopyRecord>();
    copies->insert(copies->end(), more.begin(), more.end());
    ImpulseCache other;
    other.contacts = in.GetVector<CachedImpulse>();
    other.interfaces = in.GetVector<CachedInterfaceImpulse>();
    cache->Append(other);
  }
}

/// V := mean over the copies in order of their subdomains, as the first plus the mean of the differences: exact when all agree.
/// One copy's velocity is taken as it is, here as on the rank of a body's owner (adding 0 would change the sign of -0).
void AverageCopies(std::vector<CopyRecord>* copies, const Population& population, int dofs, std::vector<Twist>* velocity) {
  std::sort(copies->begin(), copies->end(), [](const CopyRecord& a, const CopyRecord& b) {
    return std::pair(a.body, a.subdomain) < std::pair(b.body, b.subdomain);
  });
  // Copies of one body are neighbours now, in the order of their subdomains.
  for (std::size_t first = 0, last = 0; first < copies->size(); first = last) {
    double difference[3] = {0.0, 0.0, 0.0};
    const CopyRecord& head = (*copies)[first];
    for (last = first; last < copies->size() && (*copies)[last].body == head.body; ++last) {
      for (int d = 0; d < 3; ++d) difference[d] += (*copies)[last].velocity[d] - head.velocity[d];
    }
    const double count = static_cast<double>(last - first);
    Twist& v = (*velocity)[population.RowOf(head.body)];
    if (last - first == 1) {
      v = {head.velocity[0], head.velocity[1], dofs == 3 ? head.velocity[2] : v.spin};
      continue;
    }
    v.vx = head.velocity[0] + difference[0] / count;
    v.vy = head.velocity[1] + difference[1] / count;
    if (dofs == 3) v.spin = head.velocity[2] + difference[2] / count;
  }
}

/// What the subdomains of this rank know of the columns: impulses, relative velocities, and of each body some copy's velocity.
void StoreSolution(const PartitionedProblem& problem, const PartitionedState& state, StepTables* tables) {
  tables->impulse.assign(tables->contacts.size(), {});
  tables->relative_velocity.assign(tables->contacts.size(), {});
  tables->velocity = tables->columns.free_velocity;
  for (std::size_t e = 0; e < problem.subdomains.size(); ++e) {
    StoreImpulses(problem.subdomains[e], state.subdomains[e], &tables->impulse, &tables->relative_velocity);
    StoreVelocities(problem.subdomains[e], state.subdomains[e], tables->columns.inverse_mass, &tables->velocity);
  }
}

}  // namespace

void Reconcile(const PartitionedProblem& problem, const PartitionedState& state, const Population& population,
               Communicator* communicator, StepTables* tables, ImpulseCache* cache) {
  StoreSolution(problem, state, tables);
  cache->Clear();
  std::vector<CopyRecord> copies = CopiesOf(problem, state, population, tables->sharing, communicator->rank());
  AddInterfaceImpulses(problem, state, cache);
  AddContactImpulses(*problem.contacts, population.bodies, tables->impulse, cache);
  if (communicator->size() > 1) Exchange(population, communicator, &copies, cache);
  AverageCopies(&copies, population, Dofs(problem.model), &tables->velocity);
  cache->Sort();
}

}  // namespace nscdd
