// SPDX-License-Identifier: Apache-2.0
#include "nscdd/time_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/algorithms.h"
#include "algorithms/monitor.h"
#include "nscdd/error.h"
#include "nscdd/normal_law.h"
#include "parallel/agreement.h"
#include "parallel/ordered_reduction.h"
#include "partition/distribution.h"
#include "problem/initial_state.h"
#include "problem/option_checks.h"
#include "problem/subdomain_builder.h"
#include "stepping/alert_distance.h"
#include "stepping/contact_checks.h"
#include "stepping/final_gap.h"
#include "stepping/impulse_cache.h"
#include "stepping/reconcile.h"
#include "stepping/saved_state.h"
#include "stepping/step_outcome.h"

namespace nscdd {
namespace {

using Clock = std::chrono::steady_clock;
double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void Require(bool holds, const std::string& sentence) {
  if (!holds) throw Error(sentence);
}

}  // namespace

class TimeStepper::Impl {
 public:
  Impl(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter, Communicator* communicator)
      : stepping_(stepping),
        algorithm_(algorithm),
        partition_(PartitionOf(algorithm)),
        adapter_(adapter),
        communicator_(communicator),
        distribution_(adapter, communicator) {
    RunTogether(communicator, [&] {
      CheckStepping(stepping);
      CheckAlgorithm(algorithm);
      description_ = adapter->Describe();
      CheckPeriod(description_);
      const int ranks = communicator->size(), subdomains = partition_.nx * partition_.ny;
      Require(
          ranks <= subdomains,
          fmt::format("{} ranks share {} subdomain{}; a rank needs at least one: start at most {} or ask for more subdomains",
                      ranks, subdomains, subdomains == 1 ? "" : "s", subdomains));
      Require(ranks == 1 || adapter->transport() != nullptr,
              fmt::format("adapter '{}' cannot move bodies between ranks (no distributed_bodies); start one rank",
                          description_.name));
    });
    blocks_ = Blocks(partition_.nx * partition_.ny, communicator->size());
    first_subdomain_ = blocks_.First(communicator->rank());
    local_subdomains_ = blocks_.Last(communicator->rank()) - first_subdomain_;
  }

  const StepReport& Step(double dt) {
    const Clock::time_point start = Clock::now();
    const CommunicationCounters before = communicator_->counters();
    report_ = {};
    Distribute(dt);
    const double waited = communicator_->counters().seconds;
    report_.seconds_detect = SecondsSince(start) - (waited - before.seconds);
    const Clock::time_point solving = Clock::now();
    Prepare(dt);
    SolveProblem(dt);
    report_.seconds_solve = SecondsSince(solving) - (communicator_->counters().seconds - waited);
    Advance(dt);
    std::swap(cache_, next_cache_);
    ++step_;
    time_ += dt;
    report_.step = step_;
    report_.time = time_;
    CountCommunication(before);
    report_.seconds_communicate = communicator_->counters().seconds - before.seconds;
    report_.seconds_total = SecondsSince(start);
    return report_;
  }

  std::vector<std::byte> SaveState() const;
  void LoadState(std::span<const std::span<const std::byte>> parts);

  StepOutcome outcome_;

 private:
  const BodyTable& bodies() const { return distribution_.population().bodies; }
  std::size_t rows() const { return distribution_.population().size(); }
  bool IsFree(std::size_t row) const { return bodies().kind[row] == BodyKind::kFree; }
  int HomeOf(const Pose& q) const { return grid_.CellOf(Centre(q)); }

  Pose Drift(const Pose& q, const Twist& v, double dt) const {
    return {grid_.Wrap(q.x + dt * v.vx), q.y + dt * v.vy, q.angle + dt * v.spin};
  }

  void Distribute(double dt);
  double alert() const { return std::max(0.0, alert_); }
  void PlaceCuts(const std::vector<Pose>& detection, double dt, double* largest_radius, bool* newcomers);
  void Detect();
  void SelectContacts();
  std::vector<std::pair<std::int32_t, std::int32_t>> TouchedBodies() const;
  void Prepare(double dt);
  void ComputeFreeVelocity(double dt);
  void ComputeOffsets(double dt);
  void ReduceScales(double dt);
  void SolveProblem(double dt);
  void Advance(double dt);
  void RecordContacts(double half);
  void Summarise(double dt);
  void CountCommunication(const CommunicationCounters& before);

  SteppingOptions stepping_;
  AlgorithmOptions algorithm_;
  PartitionOptions partition_;
  PlatformAdapter* adapter_;
  Communicator* communicator_;
  AdapterDescription description_;
  Blocks blocks_;
  int first_subdomain_ = 0, local_subdomains_ = 1;

  // Kept between steps.
  Distribution distribution_;
  Grid grid_;
  ImpulseCache cache_;
  bool is_cache_scattered_ = false;  // loaded: its entries may be on other ranks than their bodies
  InterfaceWorkspace workspace_;
  double alert_ = -1.0;  // [m] < 0: not chosen yet
  std::int64_t step_ = 0;
  double time_ = 0.0;

  // Of the present step.
  std::vector<Pose> detection_;  // q_m of every row
  ContactTable contacts_;
  std::vector<std::vector<std::int32_t>> chosen_;  // rows of contacts_ of each of this rank's subdomains, by key
  std::vector<std::int32_t> solved_;               // all of them in the order of the table
  std::vector<double> inverse_mass_, inverse_inertia_, offset_, approach_;
  std::vector<Twist> free_velocity_, velocity_;    // by row; velocity_ of rows that only others own is their local copy's
  std::vector<Vec2> impulse_, relative_velocity_;  // by row of contacts_
  ImpulseCache next_cache_;                        // becomes cache_ once the step has succeeded
  Sharing sharing_;
  PartitionedProblem problem_;
  StepReport report_;
};

// 1 distribute, 2 read, 3 detect (numbers of architecture.md section 3).
void TimeStepper::Impl::Distribute(double dt) {
  RunTogether(communicator_, [&] {
    Require(std::isfinite(dt) && dt > 0.0, fmt::format("the time step is {} s; it must be positive and finite", dt));
    BodyTable read;
    adapter_->ReadBodies(&read);
    CheckBodies(read, description_);
    CheckDrift(read, (1.0 - stepping_.theta) * dt, description_);
    distribution_.TakeOver(std::move(read));
  });
  if (is_cache_scattered_) DeliverToOwners(bodies().id, communicator_, &cache_);
  if (alert_ < 0.0) alert_ = stepping_.alert_distance;
  if (alert_ < 0.0) alert_ = DefaultAlertDistance(bodies(), communicator_);
  const double half = (1.0 - stepping_.theta) * dt;
  if (description_.period > 0.0 && step_ == 0) grid_.SetPeriod(description_.period_origin, description_.period);
  const auto drift_all = [&] {
    detection_.resize(rows());
    for (std::size_t i = 0; i < rows(); ++i) detection_[i] = Drift(bodies().pose[i], bodies().velocity[i], half);
  };
  drift_all();
  Reach reach;
  reach.alert = alert();
  bool newcomers = false;
  PlaceCuts(detection_, dt, &reach.largest_radius, &newcomers);
  if (newcomers) distribution_.CheckIdsAreUnique();
  distribution_.Move(detection_, grid_, blocks_, reach, &cache_);
  is_cache_scattered_ = false;
  if (communicator_->size() > 1) drift_all();
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  RunTogether(communicator_, [&] {
    Detect();
    SelectContacts();
    pairs = TouchedBodies();
  });
  sharing_ = distribution_.Share(std::move(pairs));
}

/// The grid covers the centres of the free bodies (minima and maxima are exact in any order). Also sees that `dt` is the same
/// on all ranks.
void TimeStepper::Impl::PlaceCuts(const std::vector<Pose>& detection, double dt, double* largest_radius, bool* newcomers) {
  const double infinity = std::numeric_limits<double>::infinity();
  double box[8] = {infinity, infinity, infinity, infinity, 0.0, -static_cast<double>(distribution_.newcomers()), dt, -dt};
  for (std::size_t i = 0; i < rows(); ++i) {
    box[4] = std::min(box[4], -bodies().radius[i]);
    if (!IsFree(i)) continue;
    box[0] = std::min(box[0], detection[i].x);
    box[1] = std::min(box[1], detection[i].y);
    box[2] = std::min(box[2], -detection[i].x);
    box[3] = std::min(box[3], -detection[i].y);
  }
  communicator_->AllReduceMin(box);
  if (box[6] != -box[7])
    throw Error(fmt::format("the ranks have time steps from {} to {} s; give all the same", box[6], -box[7]));
  *largest_radius = -box[4];
  *newcomers = box[5] < 0.0;
  if (step_ % partition_.repartition_every != 0) return;
  const bool empty = box[0] == infinity;
  grid_ = Grid(empty ? Vec2{} : Vec2{box[0], box[1]}, empty ? Vec2{} : Vec2{-box[2], -box[3]}, partition_.nx, partition_.ny);
  if (description_.period > 0.0) grid_.SetPeriod(description_.period_origin, description_.period);
}

void TimeStepper::Impl::Detect() {
  contacts_.Clear();
  adapter_->DetectContacts({bodies().id, detection_}, alert(), &contacts_);
  CheckContacts(contacts_, bodies(), alert(), description_);
}

// 4 partition: each contact to the subdomain of its site.
void TimeStepper::Impl::SelectContacts() {
  chosen_.resize(local_subdomains_);
  for (auto& list : chosen_) list.clear();
  solved_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (stepping_.normal_law == NormalLaw::kStrict && contacts_.gap[c] > 0.0) continue;
    const int e = grid_.CellOf(contacts_.site[c]) - first_subdomain_;
    if (e < 0 || e >= local_subdomains_) continue;
    chosen_[e].push_back(static_cast<std::int32_t>(c));
    solved_.push_back(static_cast<std::int32_t>(c));
  }
}

/// (row, subdomain) of every free body with a contact in one of this rank's subdomains, each once.
std::vector<std::pair<std::int32_t, std::int32_t>> TimeStepper::Impl::TouchedBodies() const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  std::vector<std::int32_t> last(rows(), -1);  // subdomain that named the row last
  pairs.reserve(rows());
  for (std::size_t e = 0; e < chosen_.size(); ++e) {
    const int subdomain = first_subdomain_ + static_cast<int>(e);
    for (const std::int32_t c : chosen_[e]) {
      for (const std::int32_t body : {contacts_.a[c], contacts_.b[c]}) {
        if (last[body] == subdomain || !IsFree(body)) continue;
        last[body] = subdomain;
        pairs.emplace_back(body, subdomain);
      }
    }
  }
  return pairs;
}

// 5 build.
void TimeStepper::Impl::Prepare(double dt) {
  ComputeFreeVelocity(dt);
  ComputeOffsets(dt);
  ReduceScales(dt);
  const ProblemTables tables{inverse_mass_, inverse_inertia_, free_velocity_, &contacts_, offset_, &sharing_};
  SubdomainBuilder builder(tables, problem_.model);
  problem_.subdomains.clear();
  for (int e = 0; e < local_subdomains_; ++e) {
    problem_.subdomains.push_back(builder.Build(first_subdomain_ + e, chosen_[e]));
  }
  problem_.interface = MakeInterfaceMap(problem_.subdomains, sharing_, blocks_, communicator_->rank());
  problem_.contacts = &contacts_;
  problem_.dt = dt;
  problem_.body_id = &bodies().id;
}

/// V_f = V_i + dt M^-1 f; prescribed bodies keep theirs.
void TimeStepper::Impl::ComputeFreeVelocity(double dt) {
  inverse_mass_.assign(rows(), 0.0);
  inverse_inertia_.assign(rows(), 0.0);
  free_velocity_ = bodies().velocity;
  for (std::size_t i = 0; i < rows(); ++i) {
    if (!IsFree(i)) continue;
    inverse_mass_[i] = 1.0 / bodies().mass[i];
    inverse_inertia_[i] = 1.0 / bodies().inertia[i];
    const Wrench& f = bodies().force[i];
    free_velocity_[i].vx += dt * inverse_mass_[i] * f.fx;
    free_velocity_[i].vy += dt * inverse_mass_[i] * f.fy;
    free_velocity_[i].spin += dt * inverse_inertia_[i] * f.torque;
  }
}

void TimeStepper::Impl::ComputeOffsets(double dt) {
  offset_.assign(contacts_.size(), 0.0);
  approach_.assign(contacts_.size(), 0.0);
  for (const std::int32_t c : solved_) {
    const Twist &va = bodies().velocity[contacts_.a[c]], &vb = bodies().velocity[contacts_.b[c]];
    double approach = Dot(contacts_.normal[c], Linear(vb) - Linear(va));
    if (contacts_.has_arms()) {
      approach +=
          Cross(contacts_.arm_b[c], contacts_.normal[c]) * vb.spin - Cross(contacts_.arm_a[c], contacts_.normal[c]) * va.spin;
    }
    approach_[c] = approach;
    const double levers = contacts_.lever_a[c] + contacts_.lever_b[c];
    offset_[c] = NormalOffset(stepping_, contacts_.gap[c], levers, approach, contacts_.restitution[c], dt);
  }
}

/// What all ranks must know before they build: the unknowns required, scales of the residuals, counts.
void TimeStepper::Impl::ReduceScales(double dt) {
  // sums: |dt f|^2, |dt f|^2 / m, contacts, free bodies, radii, masses;  maxima: |dt f| / m, approach speed, friction, arms
  std::vector<ReductionPart<6, 4>> parts(local_subdomains_);
  for (auto& part : parts) part = {};
  for (std::size_t i = 0; i < rows(); ++i) {
    if (!IsFree(i) || !distribution_.Owns(i)) continue;
    auto& part = parts[HomeOf(detection_[i]) - first_subdomain_];
    const Wrench& f = bodies().force[i];
    const double f2 = dt * dt * (f.fx * f.fx + f.fy * f.fy);
    part[0] += f2;
    part[1] += f2 * inverse_mass_[i];
    part[3] += 1.0;
    part[4] += bodies().radius[i];
    part[5] += bodies().mass[i];
    part[6] = std::max(part[6], std::sqrt(f2) * inverse_mass_[i]);
  }
  for (std::size_t e = 0; e < chosen_.size(); ++e) {
    parts[e][2] = static_cast<double>(chosen_[e].size());
    // A negative offset asks for a speed too: that of recovery.
    for (const std::int32_t c : chosen_[e]) parts[e][7] = std::max({parts[e][7], -approach_[c], -offset_[c]});
  }
  const ContactModel mine = RequiredModel({inverse_mass_, inverse_inertia_, free_velocity_, &contacts_, offset_, &sharing_});
  parts.front()[8] = HasFriction(mine);
  parts.front()[9] = HasArms(mine);
  const auto t = ReduceInOrder<6, 4>(parts, communicator_);
  problem_.scales = {std::sqrt(t[0]), std::max(t[6], t[7]), t[1]};
  problem_.mean_mass = t[3] > 0.0 ? t[5] / t[3] : 0.0;
  problem_.contact_count = static_cast<std::int64_t>(t[2]);
  problem_.model = t[8] > 0.0 ? (t[9] > 0.0 ? ContactModel::kFrictionArms : ContactModel::kFriction)
                              : (t[9] > 0.0 ? ContactModel::kNormalArms : ContactModel::kNormal);
  report_.bodies = static_cast<std::int64_t>(t[3]);
  report_.mean_radius = t[3] > 0.0 ? t[4] / t[3] : 0.0;
}

// 6 warm start, 7 solve, 8 reconcile.
void TimeStepper::Impl::SolveProblem(double dt) {
  const double scale = cache_.dt > 0.0 ? dt / cache_.dt : 1.0;
  const bool warm = stepping_.warm_start && cache_.dt > 0.0;
  PartitionedState state =
      InitialState(problem_, warm ? WarmImpulses(cache_, contacts_, bodies().id, scale) : std::vector<Vec2>{});
  if (warm && !problem_.interface.copies.empty()) {
    state.interface.impulse =
        WarmInterfaceImpulses(cache_, problem_.interface, sharing_, problem_.subdomains, bodies().id, scale);
    Gluing(problem_.subdomains, problem_.interface, communicator_).SubtractImpulse(state.interface, &state.subdomains);
  }
  report_.solve =
      problem_.contact_count == 0
          ? ReportWithoutContacts(problem_)
          : std::visit([&](const auto& o) { return Solve(problem_, o, communicator_, &workspace_, &state); }, algorithm_);
  report_.solve.subdomains = grid_.cells();
  if (problem_.contact_count == 0) report_.solve.empty_subdomains = grid_.cells();

  impulse_.assign(contacts_.size(), {});
  relative_velocity_.assign(contacts_.size(), {});
  velocity_ = free_velocity_;
  for (std::size_t e = 0; e < problem_.subdomains.size(); ++e) {
    StoreImpulses(problem_.subdomains[e], state.subdomains[e], &impulse_, &relative_velocity_);
    StoreVelocities(problem_.subdomains[e], state.subdomains[e], inverse_mass_, &velocity_);
  }
  Reconcile(problem_, state, distribution_, sharing_, solved_, impulse_, communicator_, &velocity_, &next_cache_);
  next_cache_.dt = dt;
}

// 9 move, 10 commit, 11 report.
void TimeStepper::Impl::Advance(double dt) {
  const double half = stepping_.theta * dt;
  RecordContacts(half);
  outcome_.bodies.clear();
  for (std::size_t i = 0; i < rows(); ++i) {
    if (!distribution_.Owns(i)) continue;
    const BodyTable& t = bodies();
    Pose end = Drift(detection_[i], velocity_[i], half);
    if (!IsFree(i) && velocity_[i].vx == 0.0) end.x = t.pose[i].x;  // a standing wall stays where its host has it
    outcome_.bodies.push_back(
        {t.id[i], t.kind[i], t.radius[i], end, velocity_[i], sharing_.Multiplicity(i), HomeOf(detection_[i])});
  }
  Summarise(dt);
  RunTogether(communicator_, [&] { outcome_.Commit(adapter_); });
}

void TimeStepper::Impl::RecordContacts(double half) {
  outcome_.contacts.clear();
  const bool arms = contacts_.has_arms();
  for (std::size_t e = 0; e < chosen_.size(); ++e) {
    for (const std::int32_t c : chosen_[e]) {
      const std::int32_t a = contacts_.a[c], b = contacts_.b[c];
      // Positions without the wrap at the period's ends, so that distances stay those of this image.
      const auto moved = [&](std::int32_t row) {
        const Pose& q = detection_[row];
        const Twist& v = velocity_[row];
        return Pose{q.x + half * v.vx, q.y + half * v.vy, q.angle + half * v.spin};
      };
      const double shift = contacts_.has_images() ? contacts_.image[c] * description_.period : 0.0;
      const double bound = contacts_.friction[c] * impulse_[c].x;
      const int status = impulse_[c].x <= 0.0 ? 0 : std::abs(impulse_[c].y) < bound ? 1 : 2;
      const Vec2 point =
          Centre(detection_[a]) + (arms ? contacts_.arm_a[c] : Vec2{}) + contacts_.lever_a[c] * contacts_.normal[c];
      outcome_.contacts.push_back({KeyOf(contacts_, c, bodies().id), contacts_.gap[c],
                                   FinalGap(contacts_, c, detection_[a], detection_[b], moved(a), moved(b), shift),
                                   contacts_.normal[c], point, impulse_[c], relative_velocity_[c], status,
                                   first_subdomain_ + static_cast<int>(e)});
    }
  }
}

void TimeStepper::Impl::Summarise(double dt) {
  // sums: kinetic energy, momentum, interpenetration, injected energy;  maxima: interpenetration, drift, numbers that are not
  // finite
  std::vector<ReductionPart<5, 3>> parts(local_subdomains_);
  for (auto& part : parts) part = {};
  for (std::size_t i = 0; i < rows(); ++i) {
    if (!IsFree(i) || !distribution_.Owns(i)) continue;
    auto& part = parts[HomeOf(detection_[i]) - first_subdomain_];
    const Twist& v = velocity_[i];
    const double m = bodies().mass[i], speed2 = v.vx * v.vx + v.vy * v.vy;
    part[0] += 0.5 * (m * speed2 + bodies().inertia[i] * v.spin * v.spin);
    part[1] += m * v.vx;
    part[2] += m * v.vy;
    const Vec2 drift = (1.0 - stepping_.theta) * dt * Linear(bodies().velocity[i]) + stepping_.theta * dt * Linear(v);
    part[6] = std::max(part[6], std::sqrt(Dot(drift, drift)));
  }
  parts.front()[7] = outcome_.IsFinite() ? 0.0 : 1.0;
  std::size_t row = 0;
  for (std::size_t e = 0; e < chosen_.size(); ++e) {
    for (const std::int32_t c : chosen_[e]) {
      const double interpenetration = std::max(0.0, -outcome_.contacts[row++].final_gap);
      parts[e][3] += interpenetration;
      parts[e][4] += impulse_[c].x * std::max(0.0, -NormalOffset(stepping_, contacts_.gap[c], 0.0, 0.0, 0.0, dt));
      parts[e][5] = std::max(parts[e][5], interpenetration);
    }
  }
  const auto t = ReduceInOrder<5, 3>(parts, communicator_);
  if (t[7] > 0.0) RunTogether(communicator_, [&] { outcome_.RequireFinite(); });
  report_.kinetic_energy = t[0];
  report_.momentum_x = t[1];
  report_.momentum_y = t[2];
  report_.mean_interpenetration = problem_.contact_count > 0 ? t[3] / static_cast<double>(problem_.contact_count) : 0.0;
  report_.max_interpenetration = t[5];
  report_.injected_energy = t[4];
  report_.max_drift = t[6];
  report_.alert_distance = alert();
}

void TimeStepper::Impl::CountCommunication(const CommunicationCounters& before) {
  report_.migrated_bodies = distribution_.migrated();
  if (communicator_->size() == 1) return;
  const CommunicationCounters& now = communicator_->counters();
  const double mine[3] = {static_cast<double>(now.messages - before.messages), static_cast<double>(now.bytes - before.bytes),
                          static_cast<double>(distribution_.migrated())};
  report_.collectives = now.collectives - before.collectives + 1;
  const std::vector<double> all = communicator_->AllGather(mine);
  report_.migrated_bodies = 0;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    report_.messages += static_cast<std::int64_t>(all[i]);
    report_.message_bytes += static_cast<std::int64_t>(all[i + 1]);
    report_.migrated_bodies += static_cast<std::int64_t>(all[i + 2]);
  }
}

std::vector<std::byte> TimeStepper::Impl::SaveState() const {
  return WriteState({step_, time_, alert_, cache_.dt, grid_}, cache_, partition_.nx, partition_.ny, *communicator_);
}

void TimeStepper::Impl::LoadState(std::span<const std::span<const std::byte>> parts) {
  ImpulseCache cache;
  const StepperState state = ReadStates(parts, partition_.nx, partition_.ny, communicator_, &cache);
  if (state.step > 0 && !state.grid.HasPeriod(description_.period_origin, description_.period)) {
    throw Error(fmt::format("the saved state is of a world with another period than {} m from {} m (0: none)",
                            description_.period, description_.period_origin));
  }
  distribution_.Forget();
  step_ = state.step;
  time_ = state.time;
  alert_ = state.alert;
  grid_ = state.grid;
  cache_ = std::move(cache);
  is_cache_scattered_ = true;
}

TimeStepper::TimeStepper(const SteppingOptions& stepping, const AlgorithmOptions& algorithm, PlatformAdapter* adapter,
                         Communicator* communicator)
    : impl_(std::make_unique<Impl>(stepping, algorithm, adapter, communicator)) {}
TimeStepper::~TimeStepper() = default;
TimeStepper::TimeStepper(TimeStepper&&) noexcept = default;

const StepReport& TimeStepper::Step(double dt) { return impl_->Step(dt); }
std::vector<std::byte> TimeStepper::SaveState() const { return impl_->SaveState(); }
void TimeStepper::LoadState(std::span<const std::byte> bytes) { impl_->LoadState({&bytes, 1}); }
void TimeStepper::LoadState(std::span<const std::span<const std::byte>> parts) { impl_->LoadState(parts); }
std::span<const BodyRecord> TimeStepper::bodies() const { return impl_->outcome_.bodies; }
std::span<const ContactRecord> TimeStepper::contacts() const { return impl_->outcome_.contacts; }

}  // namespace nscdd
