// SPDX-License-Identifier: Apache-2.0
#include "commands/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "auto/pilot.h"
#include "commands/print_notes.h"
#include "scene/grain_size.h"
#include "scene/oddities.h"
#include "scene/platform.h"
#include "scene/read_scene.h"

namespace nscdd {
namespace {

/// Rows in ascending order of id, as DetectContacts wants them.
struct Poses {
  std::vector<std::int64_t> id;
  std::vector<Pose> pose;
};

Poses SortedPoses(const BodyTable& bodies) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return bodies.id[a] < bodies.id[b]; });
  Poses sorted;
  for (const std::size_t i : order) {
    sorted.id.push_back(bodies.id[i]);
    sorted.pose.push_back(bodies.pose[i]);
  }
  return sorted;
}

/// As the run will use it: the scene's, or a tenth of the mean radius.
double AlertDistance(const SolverChoice& choice, const SolverRegistry& registry, double mean_radius) {
  const double asked = SteppingOf(choice, registry).alert_distance;
  return asked < 0.0 ? 0.1 * mean_radius : asked;
}

void PrintContacts(const ContactTable& contacts, const Poses& poses, double alert, double mean_radius) {
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
               -contacts.gap[deepest], poses.id[contacts.a[deepest]], poses.id[contacts.b[deepest]]);
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

  BodyTable bodies;
  platform->adapter().ReadBodies(&bodies);
  const Poses poses = SortedPoses(bodies);
  const double mean_radius = MeanGrainRadius(scene);
  const double alert = AlertDistance(choice, registry, mean_radius);
  ContactTable contacts;
  platform->adapter().DetectContacts({poses.id, poses.pose}, alert, &contacts);
  const auto free = std::count(bodies.kind.begin(), bodies.kind.end(), BodyKind::kFree);
  fmt::print("scene       {}{}{}\n", scene.name, scene.title.empty() ? "" : ": ", scene.title);
  fmt::print("bodies      {} free, {} prescribed; mean disk radius {:.6g} m\n", free, bodies.size() - free, mean_radius);
  PrintContacts(contacts, poses, alert, mean_radius);
  fmt::print("time        {} steps of {} s\n", scene.time.steps, scene.time.dt);
  fmt::print("solver      {}{}", pilot ? "auto, first rung: " : "", choice.name);
  for (const auto& [key, value] : choice.options) fmt::print(", {} = {}", key, value);
  fmt::print("\nadapter     {}\nThe scene is fine.\n", name);
}

}  // namespace nscdd
