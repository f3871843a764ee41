// SPDX-License-Identifier: Apache-2.0
#include "extremes/extreme_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "nscdd/error.h"
#include "nscdd/host/adapter_host.h"
#include "nscdd/reference/reference_adapter.h"

namespace nscdd {
namespace {

using Velocities = std::map<std::int64_t, Twist>;
using OptionList = std::vector<std::pair<std::string, std::string>>;

/// Larger of the two; not a number if one of them is not.
double WorstOf(double a, double b) { return std::isnan(a) || a > b ? a : b; }

/// Options of the case and of the column, those that the solver has.
OptionList OptionsFor(const ExtremeCase& c, const SolverColumn& column, const nscdd_solver_info& solver, int max_iterations) {
  OptionList all = column.options;
  all.insert(all.end(), c.options.begin(), c.options.end());
  all.emplace_back("subdomains", c.subdomains);
  all.emplace_back("criterion", c.criterion);
  all.emplace_back("tolerance", fmt::format("{}", c.tolerance));
  if (column.solver != "newton") all.emplace_back("max_iterations", fmt::format("{}", max_iterations));
  std::erase_if(all, [&](const auto& option) { return FindOption(solver, option.first) == nullptr; });
  return all;
}

Velocities FreeVelocities(const reference::World& world) {
  Velocities velocities;
  for (const reference::Body& body : world.bodies()) {
    if (body.kind == BodyKind::kFree) velocities[body.id] = body.velocity;
  }
  return velocities;
}

double KineticEnergy(const reference::Body& body, const Twist& v) {
  return 0.5 * (body.mass * (v.vx * v.vx + v.vy * v.vy) + body.inertia * v.spin * v.spin);
}

/// One case with one solver.
class CaseRun {
 public:
  CaseRun(const ExtremeCase& c, const SolverRegistry& registry, const std::string& solver, const OptionList& options)
      : case_(c), adapter_(&world_), host_(&adapter_), solver_(registry.Create({solver, options, host_.table(), {}})) {
    world_.gravity = c.gravity;
    for (const reference::Body& body : c.bodies) world_.Add(body);
  }

  /// Error is filled by the caller, who knows the truth.
  Outcome Run() {
    for (std::int64_t k = 0; k < case_.steps; ++k) {
      const Velocities before = FreeVelocities(world_);
      solver_.Step(case_.dt);
      ReadReport(solver_.Report());
      CheckBalance(before);
    }
    return outcome_;
  }

  const reference::World& world() const { return world_; }

 private:
  void ReadReport(const StepReport& report) {
    const SolveReport& solve = report.solve;
    outcome_.iterations = std::max<std::int64_t>(outcome_.iterations, solve.iterations);
    outcome_.contacts = std::max(outcome_.contacts, solve.contacts);
    outcome_.nat = WorstOf(outcome_.nat, solve.residuals.nat);
    outcome_.nat_max = WorstOf(outcome_.nat_max, solve.residuals.nat_max);
    if (outcome_.status.empty() || solve.status != SolveStatus::kConverged) {
      outcome_.status = NameOf(solve.status);
      outcome_.sentence = solve.reason;
    }
    if (report.beyond_reach > 0) {
      outcome_.sentence += fmt::format("; WARNING: body {} moved beyond its reach in step {}, contacts may have been missed",
                                       report.beyond_reach_body, report.step);
    }
    // The core's own word on a criterion that does not see everything.
    warned_ = warned_ || outcome_.sentence.find("WARNING") != std::string::npos;
    outcome_.verdict = outcome_.status == "converged" && !warned_ ? Verdict::kHolds : Verdict::kLimit;
  }

  /// Momentum and energy of the last step against the free velocities V_f = V + dt M^-1 f.
  void CheckBalance(const Velocities& before) {
    Vec2 momentum{};
    double impulses = 0.0, energy = 0.0, scale = 0.0;
    for (const auto& [id, v] : before) {
      const reference::Body& body = *world_.Find(id);
      const Twist free{v.vx + case_.dt * world_.gravity.x, v.vy + case_.dt * world_.gravity.y, v.spin};
      momentum = momentum + body.mass * (Linear(body.velocity) - Linear(free));
      energy += KineticEnergy(body, body.velocity) - KineticEnergy(body, free);
      scale += KineticEnergy(body, free) + KineticEnergy(body, {case_.scale, 0.0, 0.0});
      impulses += body.mass * (std::abs(free.vx) + std::abs(free.vy) + case_.scale);
    }
    const TableView contacts = solver_.Table("contacts");
    for (std::size_t c = 0; c < contacts.rows(); ++c) {
      const Vec2 n{contacts.Real("normal_x")[c], contacts.Real("normal_y")[c]};
      const double rn = contacts.Real("impulse_n")[c], rt = contacts.Real("impulse_t")[c];
      const Vec2 r = rn * n + rt * Vec2{n.y, -n.x};
      impulses += std::abs(rn) + std::abs(rt);
      if (before.count(contacts.Integer("body_a")[c]) == 0) momentum = momentum - r;
      if (before.count(contacts.Integer("body_b")[c]) == 0) momentum = momentum + r;
    }
    if (impulses > 0.0) outcome_.momentum = WorstOf(outcome_.momentum, Norm(momentum) / impulses);
    if (scale > 0.0 && !case_.feeds_energy) outcome_.energy = WorstOf(outcome_.energy, energy / scale);
  }

  const ExtremeCase& case_;
  reference::World world_;
  reference::ReferenceAdapter adapter_;
  AdapterHost host_;
  Solver solver_;
  Outcome outcome_;
  bool warned_ = false;
};

Twist TruthOf(const ExtremeCase& c, std::int64_t id) {
  const auto own = c.truths.find(id);
  return own == c.truths.end() ? c.truth : own->second;
}

/// |sum m (V - V_truth)| over the mass and the scale.
double WeightError(const reference::World& world, const ExtremeCase& c) {
  Vec2 lack{};
  double mass = 0.0;
  for (const reference::Body& body : world.bodies()) {
    if (body.kind != BodyKind::kFree) continue;
    lack = lack + body.mass * (Linear(body.velocity) - Linear(TruthOf(c, body.id)));
    mass += body.mass;
  }
  return Norm(lack) / (mass * c.scale);
}

double ErrorOf(const reference::World& world, const ExtremeCase& c) {
  double error = 0.0;
  for (const reference::Body& body : world.bodies()) {
    if (body.kind != BodyKind::kFree) continue;
    const Twist expected = TruthOf(c, body.id);
    const double spin = body.disks.front().radius * (body.velocity.spin - expected.spin);
    for (const double part : {body.velocity.vx - expected.vx, body.velocity.vy - expected.vy, spin}) {
      error = WorstOf(error, std::abs(part) / c.scale);
    }
  }
  return error;
}

/// The case with the velocities of the tightest solution that the plugin finds as its truth. Returns their nat_max.
double SolveTightly(const SolverRegistry& registry, ExtremeCase* c) {
  double best = std::numeric_limits<double>::infinity();
  ExtremeCase tight = *c;
  tight.criterion = "nat_max";
  tight.tolerance = 1e-13;
  for (const SolverColumn& column :
       {SolverColumn{"", "newton", {}}, SolverColumn{"", "nscd", {{"acceleration", "anderson"}}}}) {
    const nscdd_solver_info& solver = *registry.Find(column.solver).info;
    CaseRun run(tight, registry, column.solver, OptionsFor(tight, column, solver, 200000));
    const double nat_max = run.Run().nat_max;
    if (!(nat_max < best)) continue;
    best = nat_max;
    c->truths = FreeVelocities(run.world());
  }
  return best;
}

void Judge(const ExtremeCase& c, double reference, Outcome* o) {
  // What the criterion promises at a contact, in units of the scale, adds up along a chain; gaps carry the rounding of the
  // coordinates.
  const double count = std::max<double>(1.0, static_cast<double>(o->contacts));
  const double promise = c.criterion == "nat" ? std::min(0.1, 1e3 * c.tolerance) : 10.0 * (c.tolerance + reference);
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * (1.0 + c.extent / (c.dt * c.scale));
  o->bound = c.by_weight ? 0.01 : count * c.amplification * (promise + rounding * static_cast<double>(c.steps));
  if (c.has_no_solution) {
    const bool named = o->sentence.find("squeeze: ") != std::string::npos;
    o->verdict = o->status == "converged" ? Verdict::kSilent : named ? Verdict::kHolds : Verdict::kLimit;
    return;
  }
  const bool finite = std::isfinite(o->error) && std::isfinite(o->momentum) && std::isfinite(o->energy);
  const bool balanced = o->momentum <= 1e-15 * (5e4 + c.lambda + count * static_cast<double>(o->iterations));
  const bool fed = o->status == "converged" && o->energy > o->bound;
  if (!finite || !balanced || fed) {
    o->verdict = Verdict::kBroken;
  } else if (o->error <= o->bound) {
    o->verdict = Verdict::kHolds;
  } else if (o->verdict == Verdict::kHolds) {
    o->verdict = Verdict::kSilent;
  }
}

/// `reference`: nat_max of the truth.
Outcome RunOne(const ExtremeCase& c, const SolverColumn& column, const SolverRegistry& registry, int max_iterations,
               double reference) {
  const nscdd_solver_info& solver = *registry.Find(column.solver).info;
  Outcome outcome;
  if (!c.only_with.empty() && FindOption(solver, c.only_with) == nullptr) return outcome;
  try {
    CaseRun run(c, registry, column.solver, OptionsFor(c, column, solver, max_iterations));
    outcome = run.Run();
    outcome.error = (c.by_weight ? WeightError : ErrorOf)(run.world(), c);
    Judge(c, reference, &outcome);
  } catch (const Error& e) {
    outcome.verdict = Verdict::kRefused;
    outcome.status = "refused";
    outcome.sentence = e.what();
  }
  return outcome;
}

}  // namespace

std::vector<Outcome> RunCase(const ExtremeCase& extreme_case, const std::vector<SolverColumn>& columns,
                             const SolverRegistry& registry, int max_iterations) {
  ExtremeCase c = extreme_case;
  const double reference = c.tight ? SolveTightly(registry, &c) : 0.0;
  std::vector<Outcome> row;
  for (const SolverColumn& column : columns) row.push_back(RunOne(c, column, registry, max_iterations, reference));
  return row;
}

}  // namespace nscdd
