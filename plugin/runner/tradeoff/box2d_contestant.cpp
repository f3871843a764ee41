// SPDX-License-Identifier: Apache-2.0
#include <box2d/box2d.h>

#include <fmt/format.h>

#include <unordered_map>
#include <utility>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/error.h"
#include "scene/body_stream.h"
#include "scene/platform.h"
#include "tradeoff/box2d_surface.h"
#include "tradeoff/contestant.h"

namespace nscdd {
namespace {

/// Sums of what PostSolve reports in a step, by contact key.
///
/// Box2D's normal points from its fixture A to its B, its tangent is b2Cross(normal, 1) = (n_y, -n_x), and its impulses act on
/// B: the conventions of ContactTable. Where its A is our B, normal, tangent and the body acted on all change sign, so (r_n,
/// r_t) does not.
class ImpulseListener final : public b2ContactListener {
 public:
  using Shapes = std::unordered_map<const b2Fixture*, Box2dSurface::ShapeName>;
  explicit ImpulseListener(Shapes shapes = {}) : shapes_(std::move(shapes)) {}

  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

  std::map<ContactKey, Vec2> impulses;

 private:
  Shapes shapes_;
};

/// b2World::Step on the scene's bodies. Impulses of the time-of-impact stage, if any, are added to those of the same step.
class Box2dContestant final : public Contestant {
 public:
  Box2dContestant(const Scene& scene, const Setting& setting, bool continuous);
  ~Box2dContestant() override;

  PlatformAdapter& adapter() override { return *surface_; }
  void SetGravity(Vec2 gravity) override { platform_->SetGravity(gravity); }
  StepProblem Read(const SteppingOptions& stepping, double dt) override {
    SteppingOptions own = stepping;
    own.theta = 1.0;
    return ReadStepProblem(surface_.get(), own, dt);
  }
  void Step(double dt) override;
  Effort LastEffort() const override;
  void KeepImpulses(bool keep) override;
  const std::map<ContactKey, Vec2>& impulses() override { return listener_.impulses; }
  Snapshot Capture(std::int64_t step) override { return {step, ReadSortedBodies(surface_.get()), listener_.impulses, {}}; }
  void Put(const Snapshot& snapshot) override { PutBodies(snapshot.bodies, platform_.get()); }

 private:
  box2d::Box2dAdapter& host() { return dynamic_cast<box2d::Box2dAdapter&>(platform_->adapter()); }
  ImpulseListener::Shapes Shapes();

  int velocity_iterations_, position_iterations_;
  std::unique_ptr<Platform> platform_;
  std::unique_ptr<Box2dSurface> surface_;
  std::vector<std::int64_t> ids_;
  b2World* world_ = nullptr;
  ImpulseListener listener_;
};

int Iterations(const Setting& setting, const std::string& key) {
  const std::string text = setting.Option(key);
  const bool digits = !text.empty() && text.size() < 7 && text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits)
    throw Error(fmt::format("setting '{}': {} = '{}' is no number of iterations; give an integer", setting.name, key, text));
  return std::stoi(text);
}

void ImpulseListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
  auto a = shapes_.at(contact->GetFixtureA()), b = shapes_.at(contact->GetFixtureB());
  if (b < a) std::swap(a, b);
  Vec2& sum = impulses[{a.first, b.first, a.second, b.second, 0}];
  for (int i = 0; i < impulse->count; ++i) sum = sum + Vec2{impulse->normalImpulses[i], impulse->tangentImpulses[i]};
}

Box2dContestant::Box2dContestant(const Scene& scene, const Setting& setting, bool continuous)
    : velocity_iterations_(Iterations(setting, "velocity_iterations")),
      position_iterations_(Iterations(setting, "position_iterations")),
      platform_(MakePlatform("box2d", scene)) {
  const std::string why_not = WhyNotBox2d(scene);
  if (!why_not.empty()) throw Error("Box2D's own solver is no comparison for this scene: " + why_not);
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) {
    platform_->Add(body);
    ids_.push_back(body.id);
  });
  world_ = host().Find(ids_.front())->GetWorld();
  world_->SetAllowSleeping(false);
  world_->SetWarmStarting(true);
  world_->SetContinuousPhysics(continuous);
  const ImpulseListener::Shapes shapes = Shapes();
  std::map<Box2dSurface::ShapeName, double> skins;
  for (const auto& [fixture, name] : shapes) {
    if (fixture->GetType() != b2Shape::e_circle) skins[name] = Box2dMetresPerUnit(scene) * fixture->GetShape()->m_radius;
  }
  surface_ = std::make_unique<Box2dSurface>(&platform_->adapter(), std::move(skins));
  listener_ = ImpulseListener(shapes);
}

Box2dContestant::~Box2dContestant() { world_->SetContactListener(nullptr); }

void Box2dContestant::Step(double dt) {
  listener_.impulses.clear();
  world_->Step(static_cast<float>(dt), velocity_iterations_, position_iterations_);
}

Effort Box2dContestant::LastEffort() const {
  Effort effort;
  effort.sweeps = velocity_iterations_;
  return effort;
}

void Box2dContestant::KeepImpulses(bool keep) { world_->SetContactListener(keep ? &listener_ : nullptr); }

/// Shapes are numbered in order of creation; Box2D lists the newest first.
ImpulseListener::Shapes Box2dContestant::Shapes() {
  ImpulseListener::Shapes shapes;
  for (const std::int64_t id : ids_) {
    std::int32_t count = 0;
    for (const b2Fixture* f = host().Find(id)->GetFixtureList(); f != nullptr; f = f->GetNext()) ++count;
    for (const b2Fixture* f = host().Find(id)->GetFixtureList(); f != nullptr; f = f->GetNext()) shapes[f] = {id, --count};
  }
  return shapes;
}

}  // namespace

std::string WhyNotBox2d(const Scene& scene) {
  if (scene.periodic) return "it has no periodic direction";
  const double radius = MeanGrainRadius(scene);
  if (radius >= 0.1 && radius <= 10.0) return "";
  return fmt::format("its lengths suit grains of 0.1 to 10 m, those here have a mean radius of {:.3g} m", radius);
}

std::unique_ptr<Contestant> MakeBox2dContestant(const Scene& scene, const Setting& setting, bool continuous) {
  return std::make_unique<Box2dContestant>(scene, setting, continuous);
}

}  // namespace nscdd
