// SPDX-License-Identifier: Apache-2.0
/* A plugin that does nothing; with one of the FAULT_ definitions it is one that a host must refuse. */
#include <stddef.h>
#include <stdlib.h>
#include <unistd.h>

#include "nscdd_plugin.h"

#define EXPORT __attribute__((visibility("default")))

#ifndef FAULT_NULL_ENTRY

static int32_t Create(const nscdd_create_arguments* arguments, nscdd_solver** solver, char* error, uint64_t error_size) {
  (void)arguments;
#ifdef FAULT_CRASH
  abort();
#endif
#ifdef FAULT_HANG
  for (;;) sleep(1);
#endif
  *solver = NULL;
  if (error_size > 0) error[0] = '\0';
  return NSCDD_FAILED;
}

static void Destroy(nscdd_solver* s) { (void)s; }
#ifndef FAULT_NULL_FUNCTION
static int32_t Step(nscdd_solver* s, double dt) { return (void)s, (void)dt, NSCDD_FAILED; }
#endif
static int32_t Solve(nscdd_solver* s, const nscdd_problem* p, nscdd_solution* r) {
  return (void)s, (void)p, (void)r, NSCDD_FAILED;
}
static int32_t Report(nscdd_solver* s, nscdd_report* r) { return (void)s, (void)r, NSCDD_FAILED; }
static int32_t Table(nscdd_solver* s, const char* n, nscdd_table* t) { return (void)s, (void)n, (void)t, NSCDD_FAILED; }
static int32_t StateSize(nscdd_solver* s, uint64_t* n) { return (void)s, (void)n, NSCDD_FAILED; }
static int32_t SaveState(nscdd_solver* s, void* b, uint64_t n) { return (void)s, (void)b, (void)n, NSCDD_FAILED; }
static int32_t LoadState(nscdd_solver* s, const void* b, uint64_t n) { return (void)s, (void)b, (void)n, NSCDD_FAILED; }
static int32_t LoadStates(nscdd_solver* s, uint64_t c, const void* const* p, const uint64_t* n) {
  return (void)s, (void)c, (void)p, (void)n, NSCDD_FAILED;
}
static int32_t CheckOption(const char* s, const char* n, const char* v, char* error, uint64_t size) {
  (void)s, (void)n, (void)v;
  if (size > 0) error[0] = '\0';
  return NSCDD_FAILED;
}
static const char* LastError(nscdd_solver* s) { return (void)s, "nothing is implemented"; }

static const nscdd_option options[] = {
#ifdef FAULT_UNKNOWN_TYPE
    {"depth", 77, 0, "1", "-", "", "an option"},
#else
    {"depth", NSCDD_INTEGER, 0, "1", "-", "", "an option"},
#endif
};
static const nscdd_solver_info solvers[] = {{"nothing", "does nothing", 1, options}};

static const nscdd_plugin plugin = {
#if defined(FAULT_MAJOR)
    /* The rest of another major may be anything: no host may touch it. */
    {sizeof(nscdd_plugin), NSCDD_ABI_MAJOR + 1, NSCDD_ABI_MINOR},
    (const char*)8,
    (const char*)8,
    (const char*)8,
#elif defined(FAULT_OLD_MINOR)
    /* Sound, and of the time before load_states. */
    {offsetof(nscdd_plugin, load_states), NSCDD_ABI_MAJOR, 0},
    "old",
    "1",
    "",
#elif defined(FAULT_SHORT_MINOR)
    {offsetof(nscdd_plugin, load_states), NSCDD_ABI_MAJOR, 1},
    "bad",
    "1",
    "",
#elif defined(FAULT_TRUNCATED)
    {sizeof(nscdd_header) + 8, NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR},
    (const char*)8,
    (const char*)8,
    (const char*)8,
#elif defined(FAULT_OTHER_MPI)
    {sizeof(nscdd_plugin), NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR},
    "bad",
    "1",
    "Some Other MPI 7.0",
#elif defined(FAULT_NULL_NAME)
    {sizeof(nscdd_plugin), NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR},
    NULL,
    "1",
    "",
#else
    {sizeof(nscdd_plugin), NSCDD_ABI_MAJOR, NSCDD_ABI_MINOR},
    "bad",
    "1",
    "",
#endif
#ifdef FAULT_NO_SOLVERS
    0,
    solvers,
#else
    1,
    solvers,
#endif
#ifdef FAULT_NULL_FUNCTION
    Create,
    Destroy,
    NULL,
    Solve,
#else
    Create,
    Destroy,
    Step,
    Solve,
#endif
    Report,
    Table,
    StateSize,
    SaveState,
    LoadState,
    LastError,
    LoadStates,
    CheckOption};

#endif /* FAULT_NULL_ENTRY */

#if defined(FAULT_NO_SYMBOL) || defined(FAULT_TWO_SYMBOLS)
EXPORT const nscdd_plugin* another_entry(void);
EXPORT const nscdd_plugin* another_entry(void) { return &plugin; }
#endif
#ifndef FAULT_NO_SYMBOL
EXPORT const nscdd_plugin* nscdd_plugin_entry(void);
EXPORT const nscdd_plugin* nscdd_plugin_entry(void) {
#ifdef FAULT_NULL_ENTRY
  return NULL;
#else
  return &plugin;
#endif
}
#endif
