#include <box2d/box2d.h>
#include <fmt/format.h>

#include <map>
#include <unordered_map>

#include "contestant.h"
#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/error.h"
#include "scene/grain_size.h"
#include "scene/gravity.h"
#include "scene/platform.h"
#include "stepping/impulse_cache.h"

namespace nscdd::benchmark {
namespace {

/// Sums of what PostSolve reports in a step, by contact key.
///
/// Box2D's normal points from its fixture A to its B, its tangent is b2Cross(normal, 1) = (n_y, -n_x), and its impulses act on
/// B: the conventions of ContactTable. Where its A is our B, normal, tangent and the body acted on all change sign, so (r_n,
/// r_t) does not.
class ImpulseListener final : public b2ContactListener {
 public:
  explicit ImpulseListener(std::unordered_map<const b2Fixture*, std::pair<std::int64_t, std::int32_t>> shapes)
      : shapes_(std::move(shapes)) {}

  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    auto a = shapes_.at(contact->GetFixtureA()), b = shapes_.at(contact->GetFixtureB());
    if (b < a) std::swap(a, b);
    Vec2& sum = impulses[{a.first, b.first, a.second, b.second, 0}];
    for (int i = 0; i < impulse->count; ++i) sum = sum + Vec2{impulse->normalImpulses[i], impulse->tangentImpulses[i]};
  }

  std::map<ContactKey, Vec2> impulses;

 private:
  std::unordered_map<const b2Fixture*, std::pair<std::int64_t, std::int32_t>> shapes_;  // id of the body, number of the shape
};

struct Iterations {
  int velocity;
  int position;
  bool continuous;
};

class Box2dContestant final : public Contestant {
 public:
  Box2dContestant(const Scene& scene, const Iterations& iterations)
      : scene_(scene), iterations_(iterations), platform_(MakePlatform("box2d", scene)) {
    const double radius = MeanGrainRadius(scene);
    if (radius < 0.1 || radius > 10.0 || scene.periodic) {
      throw Error(
          "benchmark_step compares scenes without period, with grains of 0.1 to 10 m: one Box2D unit is then one metre.");
    }
    ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
      platform_->Add(body);
      ids_.push_back(body.id);
    });
    world_ = Host().Find(ids_.front())->GetWorld();
    world_->SetAllowSleeping(false);
    world_->SetWarmStarting(true);
    world_->SetContinuousPhysics(iterations.continuous);
  }

  PlatformAdapter& adapter() override { return platform_->adapter(); }

  void Step(std::int64_t step) override {
    platform_->SetGravity(GravityAt(scene_.gravity, step, scene_.time.dt));
    world_->Step(static_cast<float>(scene_.time.dt), iterations_.velocity, iterations_.position);
  }

  MeasuredStep StepAndMeasure(std::int64_t step) override {
    platform_->SetGravity(GravityAt(scene_.gravity, step, scene_.time.dt));
    const StepProblem problem = ReadStepProblem(&adapter(), scene_.time.dt, AlertDistance(scene_));
    ImpulseListener listener(Shapes());
    world_->SetContactListener(&listener);
    Step(step);
    world_->SetContactListener(nullptr);
    return Measure(problem, listener.impulses);
  }

 private:
  box2d::Box2dAdapter& Host() { return dynamic_cast<box2d::Box2dAdapter&>(platform_->adapter()); }

  /// Shapes are numbered in order of creation; Box2D lists the newest first.
  std::unordered_map<const b2Fixture*, std::pair<std::int64_t, std::int32_t>> Shapes() {
    std::unordered_map<const b2Fixture*, std::pair<std::int64_t, std::int32_t>> shapes;
    for (const std::int64_t id : ids_) {
      std::int32_t count = 0;
      for (const b2Fixture* f = Host().Find(id)->GetFixtureList(); f != nullptr; f = f->GetNext()) ++count;
      for (const b2Fixture* f = Host().Find(id)->GetFixtureList(); f != nullptr; f = f->GetNext()) shapes[f] = {id, --count};
    }
    return shapes;
  }

  MeasuredStep Measure(const StepProblem& problem, const std::map<ContactKey, Vec2>& reported) {
    MeasuredStep result;
    result.sweeps = iterations_.velocity;
    result.candidates = static_cast<std::int64_t>(problem.contacts.size());
    result.reported = static_cast<std::int64_t>(reported.size());
    std::vector<Vec2> impulse(problem.contacts.size());
    std::vector<std::int32_t> found;
    std::int64_t matched = 0;
    for (std::size_t c = 0; c < impulse.size(); ++c) {
      const auto own = reported.find(KeyOf(problem.contacts, c, problem.bodies.id));
      if (own == reported.end()) continue;
      impulse[c] = own->second;
      found.push_back(static_cast<std::int32_t>(c));
      matched += own->second.x > 0.0;
    }
    for (const auto& [key, r] : reported) result.active += r.x > 0.0;
    result.unmatched = result.active - matched;
    std::vector<Twist> velocity;
    for (const std::int64_t id : problem.bodies.id) {
      const b2Body* body = Host().Find(id);
      velocity.push_back({body->GetLinearVelocity().x, body->GetLinearVelocity().y, body->GetAngularVelocity()});
    }
    result.residuals = MeasureAnswer(problem, velocity, impulse, AllContacts(problem));
    result.on_reported = MeasureAnswer(problem, velocity, impulse, std::move(found));
    return result;
  }

  const Scene& scene_;
  Iterations iterations_;
  std::unique_ptr<Platform> platform_;
  std::vector<std::int64_t> ids_;
  b2World* world_ = nullptr;
};

}  // namespace

Entry Box2dEntry(int velocity_iterations, int position_iterations, bool continuous) {
  const Iterations iterations{velocity_iterations, position_iterations, continuous};
  return {fmt::format("Box2D {}/{}{}", velocity_iterations, position_iterations, continuous ? "" : ", not continuous"),
          [iterations](const Scene& scene) { return std::make_unique<Box2dContestant>(scene, iterations); }};
}

}  // namespace nscdd::benchmark
