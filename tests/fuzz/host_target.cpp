// SPDX-License-Identifier: Apache-2.0
// Tables through the C interface: a host whose callbacks answer with what the input says, steps, tables, state, and single
// problems. Counts are those of the arrays behind them or larger than any array can be, for nobody can know the size of a C
// array.

#include <array>
#include <string>
#include <vector>

#include "byte_source.h"
#include "nscdd_plugin.h"
#include "target.h"

extern "C" const nscdd_plugin* nscdd_plugin_entry(void);

namespace {

using nscdd::fuzz::ByteSource;

/// Bodies and contacts as columns, filled from the input.
struct Columns {
  std::vector<std::int64_t> id;
  std::vector<std::uint8_t> kind, flat;
  std::vector<double> mass, inertia, radius, bounding_radius, pose, velocity, force;
  std::vector<std::int32_t> a, b, shape_a, shape_b, image;
  std::vector<double> gap, normal, lever_a, lever_b, arm_a, arm_b, site, friction, restitution, offset, impulse;

  void FillBodies(ByteSource* in) {
    *this = {};
    const std::size_t count = in->UpTo(6);
    for (std::size_t i = 0; i < count; ++i) {
      id.push_back(in->Rarely() ? static_cast<std::int64_t>(in->Word()) : static_cast<std::int64_t>(2 * i));
      kind.push_back(in->Rarely() ? in->Byte() : i == 0);
      mass.push_back(in->Positive());
      inertia.push_back(in->Positive());
      radius.push_back(in->Positive());
      bounding_radius.push_back(in->Rarely() ? in->Positive() : radius.back());
      for (int k = 0; k < 3; ++k) {
        pose.push_back(in->Number());
        velocity.push_back(i == 0 && !in->Rarely() ? 0.0 : in->Number());
        force.push_back(in->Number());
      }
    }
  }

  void FillContacts(ByteSource* in, std::size_t bodies) {
    const std::size_t count = bodies < 2 ? in->UpTo(1) : in->UpTo(8);
    for (std::size_t c = 0; c < count; ++c) {
      const bool any = in->Rarely() || bodies < 2;
      a.push_back(any ? static_cast<std::int32_t>(in->Word()) : static_cast<std::int32_t>(std::min(c / 2, bodies - 2)));
      b.push_back(any ? static_cast<std::int32_t>(in->Word())
                      : static_cast<std::int32_t>(std::min(c / 2 + 1 + c % 2, bodies - 1)));
      shape_a.push_back(in->Rarely() ? static_cast<std::int32_t>(in->Word()) : static_cast<std::int32_t>(c));
      shape_b.push_back(0);
      image.push_back(in->Rarely() ? static_cast<std::int32_t>(in->Word()) : 0);
      gap.push_back(in->Rarely() ? in->Number() : -0.01);
      const bool upright = in->Byte() % 2 == 0;
      normal.insert(normal.end(), {in->Rarely() ? in->Number() : upright ? 0.0 : 1.0, upright ? 1.0 : 0.0});
      lever_a.push_back(in->Number());
      lever_b.push_back(in->Number());
      for (auto* pairs : {&arm_a, &arm_b, &site, &impulse}) pairs->insert(pairs->end(), {in->Number(), in->Number()});
      flat.push_back(in->Byte() % 2);
      friction.push_back(in->Positive());
      restitution.push_back(in->Rarely() ? in->Number() : 0.5);
      offset.push_back(in->Number());
    }
  }
};

std::uint64_t Count(ByteSource* in, std::size_t count) {
  constexpr std::array<std::uint64_t, 4> kHuge = {1ull << 31, 1ull << 32, 1ull << 61, ~0ull};
  return in->Rarely() ? kHuge[in->UpTo(3)] : count;
}

template <class T>
const T* Array(ByteSource* in, const std::vector<T>& column) {
  return in->Rarely() ? nullptr : column.data();
}

nscdd_contacts ShowContacts(ByteSource* in, const Columns& c, bool arms) {
  nscdd_contacts t{};
  t.count = Count(in, c.a.size());
  t.a = Array(in, c.a);
  t.b = Array(in, c.b);
  t.shape_a = Array(in, c.shape_a);
  t.shape_b = Array(in, c.shape_b);
  t.image = in->Byte() % 2 == 0 ? nullptr : c.image.data();
  t.gap = Array(in, c.gap);
  t.normal = Array(in, c.normal);
  t.lever_a = Array(in, c.lever_a);
  t.lever_b = Array(in, c.lever_b);
  t.arm_a = arms ? Array(in, c.arm_a) : nullptr;
  t.arm_b = arms ? Array(in, c.arm_b) : nullptr;
  t.site = Array(in, c.site);
  t.flat = Array(in, c.flat);
  t.friction = Array(in, c.friction);
  t.restitution = Array(in, c.restitution);
  return t;
}

/// The `user` of the callbacks.
struct Host {
  ByteSource* in;
  Columns columns;
  bool arms = false;

  std::int32_t Result() { return in->Rarely() ? static_cast<std::int32_t>(in->Byte()) - 100 : NSCDD_OK; }

  static Host& Self(void* user) { return *static_cast<Host*>(user); }

  static std::int32_t Describe(void* user, nscdd_host_description* d) {
    Host& h = Self(user);
    d->name = h.in->Rarely() ? nullptr : "fuzz";
    d->version = "1";
    d->prescribed_motion = h.in->Byte() % 2;
    d->clusters = h.arms = h.in->Byte() % 2;
    d->distributed_bodies = h.in->Rarely();
    d->period = h.in->Byte() % 4 == 1 ? h.in->Positive() : 0.0;
    d->period_origin = h.in->Byte() % 4 == 1 ? h.in->Number() : 0.0;
    return h.Result();
  }

  static std::int32_t ReadBodies(void* user, nscdd_bodies* t) {
    Host& h = Self(user);
    h.columns.FillBodies(h.in);
    const Columns& c = h.columns;
    *t = {Count(h.in, c.id.size()),
          Array(h.in, c.id),
          Array(h.in, c.kind),
          Array(h.in, c.mass),
          Array(h.in, c.inertia),
          Array(h.in, c.radius),
          Array(h.in, c.bounding_radius),
          Array(h.in, c.pose),
          Array(h.in, c.velocity),
          Array(h.in, c.force)};
    return h.Result();
  }

  static std::int32_t DetectContacts(void* user, std::uint64_t count, const std::int64_t*, const double*, double,
                                     nscdd_contacts* t) {
    Host& h = Self(user);
    h.columns.FillContacts(h.in, count);
    *t = ShowContacts(h.in, h.columns, h.arms);
    return h.Result();
  }

  static std::int32_t Commit(void* user, const nscdd_step_result* result) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 3 * result->body_count; ++i) sum += result->pose[i] + result->velocity[i];
    for (std::uint64_t i = 0; i < 2 * result->contact_count; ++i) sum += result->impulse[i];
    if (sum != sum && result->body_count + result->contact_count > 0) {
      // The sum of large finite numbers may be no number; a single one never.
      for (std::uint64_t i = 0; i < 3 * result->body_count; ++i) {
        if (result->velocity[i] != result->velocity[i]) nscdd::fuzz::Fail("NaN was committed");
      }
    }
    return Self(user).Result();
  }

  static const char* LastError(void* user) { return Self(user).in->Rarely() ? nullptr : "the host says no"; }
};

/// Options that end soon.
nscdd_create_arguments Arguments(ByteSource* in, const nscdd_host* host) {
  static const std::array<const char*, 6> solvers = {"nscd", "nscdd", "fea", "rea", "iea", "newton"};
  static const std::array<const char*, 5> grids = {"2x2", "1x1", "3x1", "1x5", "7x7"};
  static const std::array<const char*, 3> laws = {"gap", "strict", "feedback"};
  static const std::array<const char*, 2> interfaces = {"direct", "cg"};
  static std::array<const char*, 6> names = {"max_iterations", "normal_law",        "subdomains",
                                             "interface",      "cg_max_iterations", "max_interface_updates"};
  static std::array<const char*, 6> values = {"6", "", "", "", "6", "4"};
  const std::size_t solver = in->UpTo(5);
  values[1] = laws[in->UpTo(2)];
  values[2] = grids[in->UpTo(4)];
  values[3] = interfaces[in->UpTo(1)];
  nscdd_create_arguments arguments{};
  arguments.header = {sizeof arguments, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  arguments.host = host;
  arguments.solver = solvers[solver];
  arguments.option_count = solver == 0 || solver == 5 ? 2 : solver == 1 ? 3 : solver == 3 ? 6 : 5;
  arguments.option_names = names.data();
  arguments.option_values = values.data();
  return arguments;
}

void CheckResult(const nscdd_plugin& plugin, nscdd_solver* solver, std::int32_t result) {
  if (result < NSCDD_OK || result > NSCDD_BAD_CALL) nscdd::fuzz::Fail("a result that does not exist");
  if (result != NSCDD_OK) nscdd::fuzz::CheckSentence(plugin.last_error(solver));
}

void ShowTables(const nscdd_plugin& plugin, nscdd_solver* solver) {
  nscdd_report report{};
  report.header = {sizeof report, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  CheckResult(plugin, solver, plugin.report(solver, &report));
  for (const char* name : {"bodies", "contacts", "iterations"}) {
    nscdd_table table{};
    table.header = {sizeof table, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
    CheckResult(plugin, solver, plugin.table(solver, name, &table));
  }
}

void ReloadState(const nscdd_plugin& plugin, nscdd_solver* solver, ByteSource* in) {
  std::uint64_t size = 0;
  if (plugin.state_size(solver, &size) != NSCDD_OK) return;
  std::vector<std::uint8_t> bytes(size);
  CheckResult(plugin, solver, plugin.save_state(solver, bytes.data(), size));
  const std::uint8_t harm = in->Byte() % 16;
  if (harm == 15) bytes.resize(size - std::min<std::uint64_t>(size, in->Byte()));
  if (harm >= 8 && harm < 15) {
    const std::uint64_t at = in->Word() % size;
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ in->Byte());
  }
  CheckResult(plugin, solver, plugin.load_state(solver, bytes.data(), bytes.size()));
}

void SolveOne(const nscdd_plugin& plugin, nscdd_solver* solver, ByteSource* in) {
  Columns c;
  c.FillBodies(in);
  const std::size_t bodies = c.id.size();
  c.FillContacts(in, bodies);
  nscdd_problem problem{};
  problem.header = {sizeof problem, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  problem.body_count = bodies == 0 ? 0 : Count(in, bodies);
  problem.mass = Array(in, c.mass);
  problem.inertia = Array(in, c.inertia);
  problem.free_velocity = Array(in, c.velocity);
  problem.impulse = Array(in, c.force);
  problem.contacts = ShowContacts(in, c, in->Byte() % 2);
  problem.offset = Array(in, c.offset);
  problem.warm_impulse = in->Byte() % 2 ? c.impulse.data() : nullptr;
  problem.approach_speed = in->Rarely() ? in->Number() : 0.0;
  std::vector<double> velocity(3 * bodies), impulse(2 * c.a.size()), relative(2 * c.a.size());
  nscdd_solution solution{};
  solution.header = {sizeof solution, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  solution.velocity = velocity.data();
  solution.impulse = impulse.data();
  solution.relative_velocity = in->Byte() % 2 ? relative.data() : nullptr;
  CheckResult(plugin, solver, plugin.solve(solver, &problem, &solution));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ByteSource in(data, size);
  const nscdd_plugin& plugin = *nscdd_plugin_entry();
  Host user{&in, {}};
  nscdd_host host{};
  host.header = {sizeof host, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR};
  host.user = &user;
  host.describe = Host::Describe;
  host.read_bodies = Host::ReadBodies;
  host.detect_contacts = Host::DetectContacts;
  host.commit = in.Rarely() ? nullptr : Host::Commit;
  host.last_error = Host::LastError;
  const bool steps = in.Byte() % 4 != 3;
  const nscdd_create_arguments arguments = Arguments(&in, steps ? &host : nullptr);
  nscdd_solver* solver = nullptr;
  std::array<char, 4096> sentence{};
  if (plugin.create(&arguments, &solver, sentence.data(), sentence.size()) != NSCDD_OK) {
    nscdd::fuzz::CheckSentence(sentence.data());
    return 0;
  }
  for (int k = 0; k < 3 && !in.empty(); ++k) {
    if (steps) {
      const double dt = in.Rarely() ? in.Number() : 0.01;
      CheckResult(plugin, solver, plugin.step(solver, dt));
    } else {
      SolveOne(plugin, solver, &in);
    }
    if (steps && in.Byte() % 4 == 1) ReloadState(plugin, solver, &in);
    ShowTables(plugin, solver);
  }
  plugin.destroy(solver);
  return 0;
}
