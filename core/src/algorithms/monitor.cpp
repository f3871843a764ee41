// SPDX-License-Identifier: Apache-2.0
#include "algorithms/monitor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "algorithms/imbalance.h"
#include "algorithms/squeezed_bodies.h"
#include "nlgs/local_solve.h"
#include "parallel/ordered_reduction.h"
#include "problem/contact_frame.h"
#include "problem/state.h"

namespace nscdd {
namespace {

/// nat is a mean over the impulses: what light bodies do under heavy ones is lost in it, and is said aloud.
constexpr double kUneven = 1e3;        // nat_max over the tolerance of nat
constexpr double kUnevenAtMost = 0.1;  // of the scale of nat_max

/// Impulses that violate the laws with ten times the energy of all they do grow where there is no room for the bodies.
constexpr double kSqueezed = 10.0;
constexpr double kDriftShare = 1.0 / 3.0;
constexpr int kScaleEvery = 5;           // iterations: as many differences the acceleration needs between two factors
constexpr double kLoadIsNear = 0.004;    // |S|: below, a common factor disturbs the acceleration more than it gives
constexpr int kSqueezedPatience = 1000;  // iterations without a better test, then

const char* Name(Criterion criterion) {
  constexpr std::array<const char*, 5> kNames{"nat", "nat_max", "quad", "maxm", "qm16"};
  return kNames[static_cast<std::size_t>(criterion)];
}

bool SeesTheInterface(Criterion criterion) { return criterion == Criterion::kNat || criterion == Criterion::kNatMax; }

/// What a test adds up and maximises over the subdomains: NaturalParts, SweepStatistics, JumpPart.
struct MeasuredSums {
  double e2, r2, power, load, change, mass, x, y;
  double active, dv2, dv2_r2, rwr, wr2;
  double jump2, copies;
};
struct MeasuredMaxima {
  double worst;
  double dv, dv_r;
};

struct Counts {
  double active, sticking, painleve;
  double empty_subdomains, interface_bodies, interface_copies;
};
struct LargestMultiplicity {
  double multiplicity;
};

template <class Row>
void DescribeRows(const PartitionedProblem& problem, SolveReport* report) {
  report->unknowns_per_contact = Unknowns(Row::kModel);
  report->unknowns_per_body = Dofs(Row::kModel);
  report->bytes_per_contact = static_cast<int>(sizeof(Row) + Unknowns(Row::kModel) * sizeof(double));
  report->bytes_per_body = static_cast<int>((Dofs(Row::kModel) + Inertias(Row::kModel)) * sizeof(double));
  report->contacts = problem.contact_count;
  report->subdomains = problem.subdomain_count;
}

void Describe(const PartitionedProblem& problem, SolveReport* report) {
  SubdomainProblem probe;
  probe.model = problem.model;
  VisitRows(probe, [&](const auto& rows) {
    using Row = typename std::decay_t<decltype(rows)>::value_type;
    DescribeRows<Row>(problem, report);
  });
}

}  // namespace

Monitor::Monitor(const PartitionedProblem& problem, const StoppingOptions& options, Communicator* communicator, bool keep_best)
    : problem_(problem), options_(options), communicator_(communicator), keep_best_(keep_best) {
  Describe(problem, &report_);
}

void Monitor::MeasureAll(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                         const PartitionedState& state) {
  std::vector<ReductionPart<MeasuredSums, MeasuredMaxima>> parts(problem_.subdomains.size());
  worst_ = {};
  for (std::size_t e = 0; e < parts.size(); ++e) {
    // The copies agree now (or carry their mean): the residual is that of the whole problem, with whole masses.
    const NaturalParts n = NaturalResidual(problem_.subdomains[e], state.subdomains[e]);
    if (n.worst_contact >= 0 && Exceeds(n.worst, worst_.worst)) worst_ = n;
    const SweepStatistics& s = statistics[e];
    const JumpPart jump = jumps.empty() ? JumpPart{} : jumps[e];
    parts[e].sum = {n.sum_e2,   n.sum_r2,         n.sum_power,
                    n.sum_load, n.sum_change,     n.sum_mass,
                    n.sum_x,    n.sum_y,          static_cast<double>(s.active),
                    s.sum_dv2,  s.sum_dv2_r2,     s.sum_rwr,
                    s.sum_wr2,  jump.sum_squares, jump.copies};
    parts[e].max = {n.worst, s.max_dv, s.max_dv_r};
  }
  const auto [sum, max] = ReduceInOrder(parts, communicator_);
  const SweepStatistics total{static_cast<std::int64_t>(sum.active), sum.dv2, sum.dv2_r2, sum.rwr, sum.wr2, max.dv, max.dv_r};
  const StagnationMeasures stagnation = Stagnation(total, problem_.scales);
  Residuals& r = report_.residuals;
  total_ = {sum.e2, sum.r2, sum.power, sum.load, sum.change, sum.mass, sum.x, sum.y, max.worst};
  SetNatural(total_, problem_.scales, &r);
  r.quad = stagnation.quad;
  r.maxm = stagnation.maxm;
  r.qm16 = stagnation.qm16;
  r.interface_jump = sum.copies > 0.0 ? std::sqrt(sum.jump2 / sum.copies) : 0.0;
  // While no contact carries an impulse, the loads are the scale.
  const double scale = stagnation.quad_wr > 0.0 ? stagnation.quad_wr : problem_.scales.velocity;
  r.relative_jump = r.interface_jump == 0.0 ? 0.0 : scale > 0.0 ? r.interface_jump / scale : INFINITY;
  if (first_nat_max_ < 0.0) first_nat_max_ = r.nat_max;
}

void Monitor::Begin(const PartitionedState& state) {
  struct Momentum {
    double x, y;
  };
  std::vector<ReductionPart<Momentum>> parts(problem_.subdomains.size());
  for (std::size_t e = 0; e < parts.size(); ++e) {
    const NaturalParts n = NaturalResidual(problem_.subdomains[e], state.subdomains[e]);
    parts[e].sum = {n.sum_x, n.sum_y};
  }
  const Momentum start = ReduceInOrder(parts, communicator_).sum;
  momenta_ = {{0, {start.x, start.y}}};
}

/// What the second half of the iterations changed of the impulse on all prescribed bodies. Measured in boxes of 730 and 10 000
/// disks from rest, it is at least three times what is still to come.
void Monitor::SeeDrift(int iteration) {
  if (momenta_.empty()) return;
  const Vec2 now{total_.sum_x, total_.sum_y};
  momenta_.push_back({iteration, now});
  const auto later = std::upper_bound(momenta_.begin(), momenta_.end(), iteration / 2,
                                      [](int half, const TestedMomentum& m) { return half < m.iteration; });
  const double scale = ImpulseScale(total_, problem_.scales);
  const double drift = kDriftShare * Norm(now - std::prev(later)->momentum);
  Residuals& r = report_.residuals;
  if (drift > r.load_error * scale) {
    r.wall_error += 3.0 * (drift - r.load_error * scale);
    r.load_error = drift / scale;
  }
}

bool Monitor::RunsAway() const {
  const Residuals& r = report_.residuals;
  return std::isnan(r.nat) || !std::isfinite(r.nat_max) || r.nat_max > 1e6 * std::max(1.0, first_nat_max_);
}

void Monitor::Stop(SolveStatus status, std::string reason) {
  report_.status = status;
  report_.reason = std::move(reason);
}

double Monitor::CriterionNow() const {
  const Residuals& r = report_.residuals;
  const double measure = nscdd::Measure(options_, r);
  if (SeesTheInterface(options_.criterion) || r.relative_jump == INFINITY) return measure;
  return std::max(measure, r.relative_jump);
}

/// The criterion, and what is above its bound beside it.
std::string Monitor::Standing() const {
  const Residuals& r = report_.residuals;
  const Bounds bounds = BoundsOf(options_);
  std::string text = fmt::format("{} is {:.3g}", Name(options_.criterion), nscdd::Measure(options_.criterion, r));
  if (options_.tolerance == 0.0) return text;
  if (r.power > bounds.power) text += fmt::format(", power is {:.3g} (bound {:.3g})", r.power, bounds.power);
  if (r.load_error > bounds.load_error) {
    text += fmt::format(", load_error is {:.3g} (bound {:.3g})", r.load_error, bounds.load_error);
  }
  return text;
}

double Monitor::LoadScale() {
  const double s = total_.sum_load / ChangeEnergy(total_, problem_.scales);
  // Where a few contacts violate more than all others do, one factor for all would spoil the others.
  const bool helps = report_.residuals.power <= 1.0 && std::abs(s) > kLoadIsNear;
  const int iteration = report_.history.back().iteration;
  if (!helps || iteration - scaled_at_ < kScaleEvery) return 1.0;
  scaled_at_ = iteration;
  return std::clamp(1.0 - s, 0.5, 2.0);
}

bool Monitor::IsSqueezed() const { return report_.residuals.power > kSqueezed; }

std::string Monitor::ReasonOfSuccess() const {
  std::string reason = fmt::format("{} is below the tolerance {:.3g}", Name(options_.criterion), options_.tolerance);
  const double worst = report_.residuals.nat_max;
  if (options_.criterion != Criterion::kNatMax && worst > std::min(kUnevenAtMost, kUneven * options_.tolerance)) {
    reason += fmt::format(
        "; WARNING: the worst contact is off by {:.2g} of the free-fall or approach speed: criterion nat_max sees it", worst);
  }
  return reason;
}

void Monitor::KeepBest(const PartitionedState& state) {
  if (!keep_best_) return;
  best_residuals_ = report_.residuals;
  best_worst_ = worst_;
  best_state_ = state;
}

void Monitor::RestoreBest(PartitionedState* state) {
  report_.residuals = best_residuals_;
  worst_ = best_worst_;
  *state = best_state_;
}

void Monitor::SetZero(PartitionedState* state) const {
  for (std::size_t e = 0; e < problem_.subdomains.size(); ++e) {
    SubdomainState& s = state->subdomains[e];
    std::fill(s.impulse.begin(), s.impulse.end(), 0.0);
    ComputeVelocity(problem_.subdomains[e], &s);
  }
  std::fill(state->interface.impulse.begin(), state->interface.impulse.end(), 0.0);
}

const Residuals& Monitor::Measure(const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                                  const PartitionedState& state) {
  MeasureAll(statistics, jumps, state);
  return report_.residuals;
}

void Monitor::Conclude(bool subdomains_converged) {
  const double measure = CriterionNow();
  // An incomplete resolution ends by itself; what is left to say is how good it is.
  if (IsSqueezed()) {
    Stop(SolveStatus::kDiverged, fmt::format("{}, more than all that the contacts do", Standing()));
  } else if (RunsAway() || !std::isfinite(measure)) {
    Stop(SolveStatus::kDiverged,
         fmt::format("{}; nat_max is {:.3g} after {:.3g} at first", Standing(), report_.residuals.nat_max, first_nat_max_));
  } else if (measure <= options_.tolerance) {
    Stop(SolveStatus::kConverged, ReasonOfSuccess());
  } else if (subdomains_converged) {
    Stop(SolveStatus::kIncomplete, fmt::format("every subdomain converged, of the sample {}", Standing()));
  } else {
    Stop(SolveStatus::kIncomplete, fmt::format("sweeps of the subdomains reached their cap, of the sample {}", Standing()));
  }
}

bool Monitor::Stops(int iteration, const std::vector<SweepStatistics>& statistics, const std::vector<JumpPart>& jumps,
                    const PartitionedState& state) {
  MeasureAll(statistics, jumps, state);
  SeeDrift(iteration);
  const Residuals& r = report_.residuals;
  report_.history.push_back({iteration, r.nat, r.nat_max, r.qm16, r.interface_jump});
  const double measure = CriterionNow();
  if (first_ < 0.0) {
    first_ = best_ = measure;
    best_iteration_ = iteration;
    KeepBest(state);
  }

  // nat is infinite, which is no divergence, before the first impulse of bodies without loads.
  const double criterion = nscdd::Measure(options_.criterion, r);
  if (first_criterion_ < 0.0) first_criterion_ = criterion;
  const bool grew = criterion > 1.0 && criterion > 1e6 * first_criterion_;
  if (grew) {
    Stop(SolveStatus::kDiverged, fmt::format("{} after {:.3g} at the first test", Standing(), first_criterion_));
    return true;
  }
  if (RunsAway()) {
    Stop(SolveStatus::kDiverged,
         fmt::format("{}; nat_max is {:.3g} after {:.3g} at the first test", Standing(), r.nat_max, first_nat_max_));
    return true;
  }
  if (measure <= options_.tolerance) {
    Stop(SolveStatus::kConverged, ReasonOfSuccess());
    return true;
  }
  // A NaN never gets here: RunsAway() has seen it.
  if (measure < best_) {
    best_ = measure;
    best_iteration_ = iteration;
    KeepBest(state);
  }
  const bool is_fixed = options_.tolerance == 0.0;
  if (iteration >= options_.max_iterations && is_fixed) {
    Stop(SolveStatus::kFixed, fmt::format("{} after {} iterations, as many as asked for", Standing(), iteration));
    return true;
  }
  if (iteration >= options_.max_iterations) {
    Stop(SolveStatus::kIterationLimit,
         fmt::format("{} after {} iterations, tolerance {:.3g}", Standing(), iteration, options_.tolerance));
    return true;
  }
  const int patience = IsSqueezed() ? std::min(kSqueezedPatience, options_.stall_iterations) : options_.stall_iterations;
  if (!is_fixed && iteration - best_iteration_ >= patience) {
    Stop(SolveStatus::kStalled, fmt::format("{}; no test has been better for {} iterations, tolerance {:.3g}", Standing(),
                                            iteration - best_iteration_, options_.tolerance));
    return true;
  }
  return false;
}

void Monitor::CountContacts(const PartitionedState& state) {
  std::vector<ReductionPart<Counts, LargestMultiplicity>> parts(problem_.subdomains.size());
  for (std::size_t e = 0; e < parts.size(); ++e) {
    const SubdomainProblem& p = problem_.subdomains[e];
    Counts& count = parts[e].sum;
    count.empty_subdomains = p.contact_count() == 0;
    VisitRows(p, [&](const auto& rows) {
      using Row = typename std::decay_t<decltype(rows)>::value_type;
      const double* r = state.subdomains[e].impulse.data();
      for (const Row& c : rows) {
        const ContactStatus status = StatusOf(c, r);
        count.active += status != ContactStatus::kOpen;
        count.sticking += status == ContactStatus::kSticking;
        if constexpr (Row::kModel == ContactModel::kFrictionArms) count.painleve += IsPainleve(c);
        r += Unknowns(Row::kModel);
      }
    });
  }
  const InterfaceMap& map = problem_.interface;
  std::size_t body = 0;
  for (const auto& copy : map.copies) {
    while (copy.slot >= map.slot_begin[body + 1]) ++body;
    auto& part = parts[copy.problem];
    part.sum.interface_bodies += copy.slot == map.slot_begin[body];  // counted by its lowest subdomain
    part.sum.interface_copies += 1.0;
    part.max.multiplicity =
        std::max(part.max.multiplicity, static_cast<double>(map.slot_begin[body + 1] - map.slot_begin[body]));
  }
  const auto [sum, max] = ReduceInOrder(parts, communicator_);
  report_.active = static_cast<std::int64_t>(sum.active);
  report_.sticking = static_cast<std::int64_t>(sum.sticking);
  report_.painleve_contacts = static_cast<int>(sum.painleve);
  report_.empty_subdomains = static_cast<std::int64_t>(sum.empty_subdomains);
  report_.interface_bodies = static_cast<std::int64_t>(sum.interface_bodies);
  report_.interface_copies = static_cast<std::int64_t>(sum.interface_copies);
  report_.max_multiplicity = report_.contacts == 0 ? 0 : std::max(1, static_cast<int>(max.multiplicity));
}

/// Names the contact with the largest nat_max at the last measurement; of equal ones that of the lowest subdomain.
void Monitor::FindWorst() {
  std::array<double, 3> mine{-1.0, 0, 0};
  if (worst_.worst_contact >= 0) {
    const ContactTable& t = *problem_.contacts;
    const auto c = static_cast<std::size_t>(worst_.worst_contact);
    const auto id = [&](std::int32_t row) { return std::bit_cast<double>((*problem_.body_id)[row]); };  // any number fits
    mine = {worst_.worst, id(t.a[c]), id(t.b[c])};
  }
  const std::vector<double> all = communicator_->AllGather(mine);
  const double* best = all.data();
  for (std::size_t i = 3; i < all.size(); i += 3) {
    if (Exceeds(all[i], best[0])) best = &all[i];
  }
  if (best[0] < 0.0) return;
  report_.residuals.worst_body_a = std::bit_cast<std::int64_t>(best[1]);
  report_.residuals.worst_body_b = std::bit_cast<std::int64_t>(best[2]);
}

SolveReport Monitor::Finish(int iterations, std::int64_t sweeps, PartitionedState* state) {
  report_.iterations = iterations;
  report_.sweeps = sweeps;
  if (IsSqueezed() && report_.status != SolveStatus::kConverged && report_.status != SolveStatus::kFixed) {
    report_.squeezed = SqueezedBodies(problem_, *state, communicator_);
    report_.reason +=
        fmt::format("; no room is left for bodies that prescribed ones squeeze: {}", fmt::join(report_.squeezed, ", "));
  }
  if (keep_best_ && std::isfinite(best_residuals_.nat) && first_ >= 0.0 && !(CriterionNow() <= best_)) {
    RestoreBest(state);
  } else if (report_.status == SolveStatus::kDiverged) {
    SetZero(state);
  }
  FindWorst();
  CountContacts(*state);
  report_.imbalance = WorstImbalance(problem_, *state, communicator_);
  return std::move(report_);
}

SolveReport ReportWithoutContacts(const PartitionedProblem& problem) {
  SolveReport report;
  report.reason = "no contact";
  report.residuals.worst_body_a = report.residuals.worst_body_b = -1;
  Describe(problem, &report);
  report.empty_subdomains = problem.subdomain_count;
  return report;
}

}  // namespace nscdd
