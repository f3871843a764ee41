// SPDX-License-Identifier: Apache-2.0
// Scene files: read, built on both platforms and, if small, moved by two steps.

#include <string>
#include <variant>

#include "nscdd/communicator.h"
#include "nscdd/time_stepper.h"
#include "scene/platform.h"
#include "scene/read_scene.h"
#include "target.h"

namespace nscdd {
namespace {

constexpr char kDisks[] = "x,y,radius\n0,0,1\n3,0,1\n";

/// Bodies and shapes that the scene makes.
std::int64_t Size(const Scene& scene) {
  std::int64_t size = CountBodies(scene);
  for (const BodySource& source : scene.bodies) {
    if (const auto* wall = std::get_if<Wall>(&source.what))
      size += static_cast<std::int64_t>(wall->disks.size() + wall->segments.size());
    if (const auto* cluster = std::get_if<Cluster>(&source.what))
      size += source.count * static_cast<std::int64_t>(cluster->disks.size());
  }
  return size;
}

void Run(const Scene& scene, const std::string& adapter) {
  const auto platform = MakePlatform(adapter, scene);
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  NscdOptions options;
  options.stopping.max_iterations = 5;
  SerialCommunicator serial;
  SteppingOptions stepping;
  stepping.theta = scene.time.theta;
  TimeStepper stepper(stepping, options, &platform->adapter(), &serial);
  for (int step = 1; step <= 2; ++step) {
    platform->SetGravity(GravityAt(scene.gravity, step, scene.time.dt));
    stepper.Step(scene.time.dt);
  }
}

}  // namespace
}  // namespace nscdd

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nscdd;
  static const fuzz::ScratchFolder folder;
  static const auto disks = folder.Write("disks.csv", kDisks, sizeof kDisks - 1);
  const auto path = folder.Write("scene.toml", data, size);
  Scene scene;
  const bool read = fuzz::Accepts([&] { scene = ReadSceneFile(path); });
  if (!read || Size(scene) > 100) return 0;
  for (const char* adapter : {"reference", "box2d"}) {
    fuzz::Accepts([&] { Run(scene, adapter); });
  }
  return 0;
}
