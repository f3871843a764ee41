// SPDX-License-Identifier: Apache-2.0
// The core without the plugin: a disk dropped from 0.2 m comes to rest on a half-plane.
#include <cmath>
#include <cstdio>

#include "nscdd/communicator.h"
#include "nscdd/reference/reference_adapter.h"
#include "nscdd/time_stepper.h"

int main() {
  namespace reference = nscdd::reference;
  constexpr double kRadius = 0.5, kDrop = 0.2, kTimeStep = 0.005;
  reference::World world;
  world.gravity = {0.0, -9.81};
  reference::Body floor = reference::MakeWall(0);
  floor.half_planes.push_back({.normal = {0.0, 1.0}, .offset = 0.0});
  world.Add(floor);
  world.Add(reference::MakeDisk(1, {0.0, kRadius + kDrop}, kRadius, 1000.0));

  reference::ReferenceAdapter adapter(&world);
  nscdd::SerialCommunicator alone;
  nscdd::TimeStepper stepper({}, nscdd::NscdOptions{}, &adapter, &alone);
  for (int step = 0; step < 100; ++step) stepper.Step(kTimeStep);
  const reference::Body& disk = *world.Find(1);
  std::printf("y = %.6f m, vy = %.6f m/s\n", disk.pose.y, disk.velocity.vy);
  return std::abs(disk.pose.y - kRadius) < 1e-6 && std::abs(disk.velocity.vy) < 1e-6 ? 0 : 1;
}
