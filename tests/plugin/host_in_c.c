// SPDX-License-Identifier: Apache-2.0
/* A host in C: loads a solver plugin, lists its solvers, solves one contact problem and steps a world of one disk that falls on
 * a plane. Usage: host_in_c PLUGIN.so; exit code 0 when all of it worked. */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "nscdd_plugin.h"

#define HEADER(type) \
  { sizeof(type), NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR }
#define GRAVITY 9.81

/* Loads the plugin and compares the headers before anything else in the description is read. */
static const nscdd_plugin* Load(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "cannot load %s: %s\n", path, dlerror());
    return NULL;
  }
  nscdd_plugin_entry_function entry = NULL;
  void* symbol = dlsym(library, NSCDD_ENTRY_SYMBOL);
  memcpy(&entry, &symbol, sizeof(entry)); /* ISO C has no cast from an object pointer to a function pointer */
  const uint32_t least_minor = NSCDD_ABI_MINOR;
  const nscdd_plugin* plugin = entry == NULL ? NULL : entry();
  if (plugin == NULL || plugin->header.abi_major != NSCDD_ABI_MAJOR || plugin->header.abi_minor < least_minor ||
      plugin->header.struct_size < sizeof(nscdd_plugin)) {
    fprintf(stderr, "%s is no solver plugin of ABI %u.%u\n", path, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR);
    return NULL;
  }
  return plugin;
}

/* ---- one contact problem: a disk of 1 kg at rest on a plane, dt = 0.01 s */
static int SolveOne(const nscdd_plugin* plugin) {
  const char* names[] = {"tolerance"};
  const char* values[] = {"1e-12"};
  const nscdd_create_arguments arguments = {HEADER(nscdd_create_arguments), NULL, 0, 0, "nscd", 1, names, values};
  char error[512];
  nscdd_solver* solver = NULL;
  if (plugin->create(&arguments, &solver, error, sizeof(error)) != NSCDD_OK) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  const double dt = 0.01, mass[] = {INFINITY, 1.0}, inertia[] = {INFINITY, 0.125};
  const double free_velocity[] = {0, 0, 0, 0, -GRAVITY * dt, 0}, impulse[] = {0, 0, 0, 0, -GRAVITY * dt, 0};
  const int32_t a = 0, b = 1;
  const double gap = 0, normal[] = {0, 1}, lever_a = 0, lever_b = 0.5, friction = 0.3, restitution = 0, offset = 0;
  const uint8_t flat = 1;
  nscdd_problem problem = {.header = HEADER(nscdd_problem),
                           .body_count = 2,
                           .mass = mass,
                           .inertia = inertia,
                           .free_velocity = free_velocity,
                           .impulse = impulse,
                           .offset = &offset};
  problem.contacts = (nscdd_contacts){.count = 1,
                                      .a = &a,
                                      .b = &b,
                                      .gap = &gap,
                                      .normal = normal,
                                      .lever_a = &lever_a,
                                      .lever_b = &lever_b,
                                      .flat = &flat,
                                      .friction = &friction,
                                      .restitution = &restitution};
  double velocity[6], reaction[2];
  nscdd_solution solution = {HEADER(nscdd_solution), velocity, reaction, NULL};
  nscdd_report report = {.header = HEADER(nscdd_report)};
  int failed = plugin->solve(solver, &problem, &solution) != NSCDD_OK || plugin->report(solver, &report) != NSCDD_OK;
  if (failed) {
    fprintf(stderr, "%s\n", plugin->last_error(solver));
  } else {
    printf("solved: %s, r_n = %.7f, v_y = %.7f\n", report.status == NSCDD_CONVERGED ? "converged" : report.reason, reaction[0],
           fabs(velocity[4]));
  }
  plugin->destroy(solver);
  return failed;
}

/* ---- a platform: the plane y = 0 and one disk above it */
typedef struct World {
  double pose[6], velocity[6];
  int32_t plane, disk, shape;
  double gap, lever_plane, lever_disk, normal[2], site[2], friction, restitution;
  uint8_t flat;
  const char* error;
} World;

static const double kMass = 1.0, kInertia = 0.125, kRadius = 0.5;

static int32_t Describe(void* user, nscdd_host_description* d) {
  (void)user;
  *d = (nscdd_host_description){.name = "one_disk", .version = "1"};
  return NSCDD_OK;
}

static int32_t ReadBodies(void* user, nscdd_bodies* bodies) {
  World* w = user;
  static const int64_t id[] = {0, 1};
  static const uint8_t kind[] = {1, 0};
  static const double force[] = {0, 0, 0, 0, -GRAVITY, 0};
  static double mass[2], inertia[2], radius[2], bounding[2];
  mass[1] = kMass, inertia[1] = kInertia, radius[1] = bounding[1] = kRadius;
  bounding[0] = INFINITY;
  *bodies = (nscdd_bodies){2, id, kind, mass, inertia, radius, bounding, w->pose, w->velocity, force};
  return NSCDD_OK;
}

static int32_t DetectContacts(void* user, uint64_t count, const int64_t* id, const double* pose, double alert,
                              nscdd_contacts* contacts) {
  World* w = user;
  *contacts = (nscdd_contacts){0};
  if (count != 2 || id[0] != 0 || id[1] != 1) {
    w->error = "detect_contacts got bodies that are not mine";
    return NSCDD_BAD_INPUT;
  }
  w->gap = pose[4] - kRadius;
  if (w->gap > alert) return NSCDD_OK;
  w->lever_disk = kRadius + w->gap;
  w->site[0] = pose[3], w->site[1] = 0.0;
  *contacts = (nscdd_contacts){.count = 1,
                               .a = &w->plane,
                               .b = &w->disk,
                               .shape_a = &w->shape,
                               .shape_b = &w->shape,
                               .gap = &w->gap,
                               .normal = w->normal,
                               .lever_a = &w->lever_plane,
                               .lever_b = &w->lever_disk,
                               .site = w->site,
                               .flat = &w->flat,
                               .friction = &w->friction,
                               .restitution = &w->restitution};
  return NSCDD_OK;
}

static int32_t Commit(void* user, const nscdd_step_result* result) {
  World* w = user;
  for (uint64_t i = 0; i < result->body_count; ++i) {
    memcpy(w->pose + 3 * result->id[i], result->pose + 3 * i, 3 * sizeof(double));
    memcpy(w->velocity + 3 * result->id[i], result->velocity + 3 * i, 3 * sizeof(double));
  }
  return NSCDD_OK;
}

static const char* LastError(void* user) { return ((World*)user)->error; }

static int StepWorld(const nscdd_plugin* plugin) {
  World world = {.pose = {0, 0, 0, 0, 0.6, 0}, .disk = 1, .normal = {0, 1}, .friction = 0.3, .flat = 1, .error = ""};
  const nscdd_host host = {.header = HEADER(nscdd_host),
                           .user = &world,
                           .describe = Describe,
                           .read_bodies = ReadBodies,
                           .detect_contacts = DetectContacts,
                           .commit = Commit,
                           .last_error = LastError};
  const nscdd_create_arguments arguments = {HEADER(nscdd_create_arguments), &host, 0, 0, "nscd", 0, NULL, NULL};
  char error[512];
  nscdd_solver* solver = NULL;
  if (plugin->create(&arguments, &solver, error, sizeof(error)) != NSCDD_OK) {
    fprintf(stderr, "%s\n", error);
    return 1;
  }
  int failed = 0, steps = 0;
  while (steps < 40 && !failed) {
    failed = plugin->step(solver, 0.01) != NSCDD_OK;
    ++steps;
  }
  if (failed) fprintf(stderr, "%s\n", plugin->last_error(solver));
  printf("stepped: %d steps, y = %.3f, vy = %.3f\n", steps, world.pose[4], fabs(world.velocity[4]));
  plugin->destroy(solver);
  return failed;
}

int main(int count, char** arguments) {
  if (count != 2) {
    fprintf(stderr, "usage: %s PLUGIN.so\n", arguments[0]);
    return 2;
  }
  const nscdd_plugin* plugin = Load(arguments[1]);
  if (plugin == NULL) return 1;
  printf("%s %s\n", plugin->name, plugin->version);
  for (uint64_t i = 0; i < plugin->solver_count; ++i) {
    printf("  %s: %s\n", plugin->solvers[i].name, plugin->solvers[i].summary);
  }
  return SolveOne(plugin) != 0 || StepWorld(plugin) != 0;
}
