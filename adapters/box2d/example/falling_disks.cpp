// SPDX-License-Identifier: Apache-2.0
// An ordinary Box2D program: a ground, two walls, a heap of disks and a loop. Its only unusual line is the step.
#include <box2d/box2d.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "nscdd/box2d/box2d_adapter.h"
#include "nscdd/communicator.h"
#include "nscdd/error.h"
#include "nscdd/time_stepper.h"

namespace {

void AddBox(b2World* world) {
  b2BodyDef def;
  b2Body* ground = world->CreateBody(&def);
  const b2Vec2 points[] = {{-8.0f, 30.0f}, {-8.0f, 0.0f}, {8.0f, 0.0f}, {8.0f, 30.0f}};
  b2ChainShape chain;
  chain.CreateChain(points, 4, {-8.0f, 31.0f}, {8.0f, 31.0f});
  b2FixtureDef fixture;
  fixture.shape = &chain;
  fixture.friction = 0.4f;
  ground->CreateFixture(&fixture);
}

std::vector<b2Body*> AddDisks(b2World* world) {
  std::vector<b2Body*> disks;
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 7; ++column) {
      b2BodyDef def;
      def.type = b2_dynamicBody;
      def.position.Set(-6.6f + 2.1f * column + 0.3f * (row % 3), 1.5f + 2.2f * row);
      b2Body* disk = world->CreateBody(&def);
      b2CircleShape circle;
      circle.m_radius = 0.8f + 0.05f * ((3 * row + column) % 5);
      b2FixtureDef fixture;
      fixture.shape = &circle;
      fixture.density = 1.0f;
      fixture.friction = 0.4f;
      disk->CreateFixture(&fixture);
      disks.push_back(disk);
    }
  }
  return disks;
}

}  // namespace

int main() try {
  b2World world({0.0f, -10.0f});
  AddBox(&world);
  const std::vector<b2Body*> disks = AddDisks(&world);

  nscdd::box2d::Box2dAdapter adapter(&world);
  nscdd::SerialCommunicator alone;
  nscdd::TimeStepper stepper({}, nscdd::NscdOptions{}, &adapter, &alone);

  for (int step = 1; step <= 600; ++step) {
    const nscdd::StepReport& report = stepper.Step(1.0 / 100.0);  // was: world.Step(1.0f / 100.0f, 8, 3);
    if (step % 100 != 0) continue;
    const b2Body* top = *std::max_element(
        disks.begin(), disks.end(), [](const b2Body* a, const b2Body* b) { return a->GetPosition().y < b->GetPosition().y; });
    std::printf("t = %.1f s: %lld contacts, kinetic energy %.2e J, deepest overlap %.1e m, highest disk at (%.3f, %.3f)\n",
                report.time, static_cast<long long>(report.solve.contacts), report.kinetic_energy, report.max_interpenetration,
                static_cast<double>(top->GetPosition().x), static_cast<double>(top->GetPosition().y));
  }
  return 0;
} catch (const nscdd::Error& error) {
  std::fprintf(stderr, "falling_disks: %s\n", error.what());
  return 2;
}
