#include "problem/step_recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "nscdd/error.h"
#include "nscdd/normal_law.h"

namespace nscdd {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The table with its rows in ascending order of id.
BodyTable Sorted(const BodyTable& bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bodies.id[a] < bodies.id[b]; });
  BodyTable sorted;
  sorted.Resize(bodies.size());
  const auto gather = [&](const auto& from, auto* to) {
    for (std::size_t i = 0; i < order.size(); ++i) (*to)[i] = from[order[i]];
  };
  gather(bodies.id, &sorted.id);
  gather(bodies.kind, &sorted.kind);
  gather(bodies.mass, &sorted.mass);
  gather(bodies.inertia, &sorted.inertia);
  gather(bodies.radius, &sorted.radius);
  gather(bodies.bounding_radius, &sorted.bounding_radius);
  gather(bodies.pose, &sorted.pose);
  gather(bodies.velocity, &sorted.velocity);
  gather(bodies.force, &sorted.force);
  return sorted;
}

void AddBodies(const BodyTable& bodies, double dt, ContactProblem* problem) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool free = bodies.kind[i] == BodyKind::kFree;
    const double mass = free ? bodies.mass[i] : kInfinity, inertia = free ? bodies.inertia[i] : kInfinity;
    const Wrench f = free ? bodies.force[i] : Wrench{};
    const Twist& v = bodies.velocity[i];
    problem->mass.push_back(mass);
    problem->inertia.push_back(inertia);
    problem->free_velocity.push_back({v.vx + dt * f.fx / mass, v.vy + dt * f.fy / mass, v.spin + dt * f.torque / inertia});
    problem->impulse.push_back({dt * f.fx, dt * f.fy, dt * f.torque});
  }
}

void AppendRow(const ContactTable& from, std::size_t c, ContactTable* to) {
  to->a.push_back(from.a[c]);
  to->b.push_back(from.b[c]);
  to->shape_a.push_back(from.shape_a[c]);
  to->shape_b.push_back(from.shape_b[c]);
  if (from.has_images()) to->image.push_back(from.image[c]);
  to->gap.push_back(from.gap[c]);
  to->normal.push_back(from.normal[c]);
  to->lever_a.push_back(from.lever_a[c]);
  to->lever_b.push_back(from.lever_b[c]);
  if (from.has_arms()) to->arm_a.push_back(from.arm_a[c]);
  if (from.has_arms()) to->arm_b.push_back(from.arm_b[c]);
  to->site.push_back(from.site[c]);
  to->flat.push_back(from.flat[c]);
  to->friction.push_back(from.friction[c]);
  to->restitution.push_back(from.restitution[c]);
}

/// v_n before the step.
double Approach(const ContactTable& t, std::size_t c, const std::vector<Twist>& velocity) {
  const Twist &va = velocity[t.a[c]], &vb = velocity[t.b[c]];
  const double approach = Dot(t.normal[c], Linear(vb) - Linear(va));
  if (!t.has_arms()) return approach;
  return approach + Cross(t.arm_b[c], t.normal[c]) * vb.spin - Cross(t.arm_a[c], t.normal[c]) * va.spin;
}

}  // namespace

AdapterDescription StepRecorder::Describe() const {
  AdapterDescription description = adapter_->Describe();
  description.distributed_bodies = false;
  return description;
}

void StepRecorder::ReadBodies(BodyTable* bodies) {
  adapter_->ReadBodies(bodies);
  bodies_ = Sorted(*bodies);
}

void StepRecorder::DetectContacts(const PoseView& poses, double alert, ContactTable* contacts) {
  adapter_->DetectContacts(poses, alert, contacts);
  contacts_ = *contacts;
}

void StepRecorder::Commit(const StepResult& result) {
  adapter_->Commit(result);
  velocity_.assign(result.velocity.begin(), result.velocity.end());
  key_.assign(result.key.begin(), result.key.end());
  impulse_.assign(result.impulse.begin(), result.impulse.end());
  committed_ = true;
}

RecordedStep StepRecorder::Problem(const SteppingOptions& stepping, double dt) const {
  if (!committed_) throw Error("no step was solved yet, so there is no contact problem to show; solve one step at least");
  RecordedStep step{bodies_, {}, velocity_, {}};
  AddBodies(bodies_, dt, &step.problem);
  std::vector<std::size_t> order(key_.size());  // a step of several subdomains commits one subdomain's contacts behind the other's
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key_[a] < key_[b]; });
  std::size_t next = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (stepping.normal_law == NormalLaw::kStrict && contacts_.gap[c] > 0.0) continue;
    AppendRow(contacts_, c, &step.problem.contacts);
    const double approach = Approach(contacts_, c, bodies_.velocity);
    step.problem.offset.push_back(NormalOffset(stepping, contacts_.gap[c], contacts_.lever_a[c] + contacts_.lever_b[c], approach,
                                               contacts_.restitution[c], dt));
    step.problem.approach_speed = std::max(step.problem.approach_speed, -approach);
    if (next == order.size()) throw Error("the solver committed fewer impulses than it was given contacts; export needs all of them");
    step.impulse.push_back(impulse_[order[next++]]);
  }
  return step;
}

}  // namespace nscdd
