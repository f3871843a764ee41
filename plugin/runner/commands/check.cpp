// SPDX-License-Identifier: Apache-2.0
#include "commands/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "auto/pilot.h"
#include "commands/print_notes.h"
#include "nscdd/step_problem.h"
#include "scene/body_stream.h"
#include "scene/platform.h"
#include "scene/read_scene.h"

namespace nscdd {
namespace {

/// As the run will use it: the scene's, or the default.
double AlertDistance(const SolverChoice& choice, const SolverRegistry& registry, const BodyTable& bodies) {
  const double asked = SteppingOf(choice, registry).alert_distance;
  SerialCommunicator serial;
  return asked < 0.0 ? DefaultAlertDistance(bodies, &serial) : asked;
}

void PrintContacts(const ContactTable& contacts, const BodyTable& bodies, double alert, double mean_radius) {
  std::int64_t touching = 0, deep = 0, coincident = 0;
  std::size_t deepest = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    touching += contacts.gap[c] <= 0.0;
    deep += contacts.gap[c] < -0.1 * mean_radius;
    coincident += !contacts.flat[c] && contacts.lever_a[c] + contacts.lever_b[c] == 0.0;
    if (contacts.gap[c] < contacts.gap[deepest]) deepest = c;
  }
  fmt::print("contacts    {} candidates within {:.3g} m, {} of them touch\n", contacts.size(), alert, touching);
  if (contacts.size() > 0 && contacts.gap[deepest] < 0.0) {
    fmt::print("overlaps    {} deeper than a tenth of the mean radius; the deepest is {:.3g} m, of bodies {} and {}\n", deep,
               -contacts.gap[deepest], bodies.id[contacts.a[deepest]], bodies.id[contacts.b[deepest]]);
  }
  if (coincident > 0) {
    fmt::print("centres     {} pairs of disks have the same centre; they are pushed apart along y\n", coincident);
  }
}

}  // namespace

void Check(const std::filesystem::path& path, const std::string& adapter, const SolverRequest& request) {
  Scene scene = ReadSceneFile(path);
  SolverRegistry registry;
  registry.Add(FindPlugin(request.plugin));
  const auto pilot = Pilot::Make(scene, request, registry, 1);
  const SolverChoice choice = pilot ? pilot->choice() : ChooseSolver(scene, request, registry);
  NoteOddities(&scene);
  PrintNotes(scene.notes);
  const std::string name = adapter.empty() ? scene.adapter : adapter;
  const auto platform = MakePlatform(name, scene);
  ForEachBody(scene, 0, 1, [&](const BodyDefinition& body) { platform->Add(body); });
  platform->SetGravity(GravityAt(scene.gravity, 1, scene.time.dt, scene.clock()));

  const BodyTable bodies = ReadSortedBodies(&platform->adapter());
  const double mean_radius = MeanGrainRadius(scene);
  const double alert = AlertDistance(choice, registry, bodies);
  ContactTable contacts;
  platform->adapter().DetectContacts({bodies.id, bodies.pose}, alert, &contacts);
  const auto free = std::count(bodies.kind.begin(), bodies.kind.end(), BodyKind::kFree);
  fmt::print("scene       {}{}{}\n", scene.name, scene.title.empty() ? "" : ": ", scene.title);
  fmt::print("bodies      {} free, {} prescribed; mean disk radius {:.6g} m\n", free, bodies.size() - free, mean_radius);
  PrintContacts(contacts, bodies, alert, mean_radius);
  fmt::print("time        {} steps of {} s\n", scene.time.steps, scene.time.dt);
  fmt::print("solver      {}{}", pilot ? "auto, first rung: " : "", choice.name);
  for (const auto& [key, value] : choice.options) fmt::print(", {} = {}", key, value);
  fmt::print("\nadapter     {}\nThe scene is fine.\n", name);
}

}  // namespace nscdd
