// SPDX-License-Identifier: Apache-2.0
/* nscdd solver plugins: the C11 interface between a host program (a physics engine, a DEM code) and a contact solver.
 *
 * A plugin is a shared library with ONE exported symbol, nscdd_plugin_entry, of type nscdd_plugin_entry_function. It returns a
 * description that lives as long as the library is loaded. Before anything else is called or read, both sides compare the
 * header (struct_size, abi_major, abi_minor) that begins every structure crossing the interface:
 *   - the majors must be equal;
 *   - the plugin's minor must be at least the one that the host needs; what a higher minor appended is used where it is there;
 *   - struct_size must be at least the size that this minor prescribes. New members are appended, never inserted.
 * A structure's abi_minor is that of its newest member, so that an older plugin takes the structures that have not grown since.
 * Then the host compares mpi_library with its own, because communicators cross the interface.
 *
 * Conventions
 *   - SI units, double, radians, counter-clockwise positive. Signs and frames of contacts: see nscdd_contacts.
 *   - Nothing changes owner: arrays and strings given by one side are read by the other until the time stated and never freed.
 *   - No exception, longjmp or C++ object crosses. A function that can fail returns NSCDD_OK or another nscdd_result; the
 *     sentence is then at last_error() of the side that failed.
 *   - A solver handle is used by one thread at a time. Several handles may coexist in a process.
 *   - With several ranks, create, destroy, step, solve and the state functions are collective over the communicator. All ranks
 *     create the same solver with the same options and step by the same dt; what differs is refused on all of them.
 */
#ifndef NSCDD_PLUGIN_H_
#define NSCDD_PLUGIN_H_

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NSCDD_ABI_MAJOR 1u
#define NSCDD_ABI_MINOR 3u /* 1: load_states; 2: NSCDD_FIXED; 3: check_option, reports that grow, sweep_contacts */
#define NSCDD_ENTRY_SYMBOL "nscdd_plugin_entry"

typedef enum nscdd_result {
  NSCDD_OK = 0,
  NSCDD_BAD_INPUT = 1, /* what the caller gave cannot be used */
  NSCDD_FAILED = 2,    /* the callee or something below it failed (no memory, MPI, a host callback) */
  NSCDD_BAD_CALL = 3   /* null pointer, wrong order of calls, truncated structure */
} nscdd_result;

/* First member of every structure that may grow. */
typedef struct nscdd_header {
  uint64_t struct_size; /* sizeof of the whole structure as its writer knew it */
  uint32_t abi_major;
  uint32_t abi_minor;
} nscdd_header;

/* ------------------------------------------------------------------ host: what a platform gives to a solver */

/* Bodies that this process holds, one entry per body, in any order. Layout of vectors: see each comment. */
typedef struct nscdd_bodies {
  uint64_t count;
  const int64_t* id;             /* unique, >= 0, stable as long as the body lives */
  const uint8_t* kind;           /* 0 free, 1 prescribed motion (fixed bodies: with velocity zero) */
  const double* mass;            /* [kg], not read if prescribed */
  const double* inertia;         /* [kg m^2] about the centre of mass, not read if prescribed */
  const double* radius;          /* [m] of its largest disk, 0 if it has none */
  const double* bounding_radius; /* [m] of a circle about the centre of mass that holds every shape; may be infinite */
  const double* pose;            /* 3 per body: x, y of the centre of mass [m], angle [rad] */
  const double* velocity;        /* 3 per body: vx, vy [m/s], spin [rad/s] */
  const double* force;           /* 3 per body: fx, fy [N], torque [N m]; gravity included; not read if prescribed */
} nscdd_bodies;

/* Candidate contacts, one entry each, sorted by (id of A, id of B, shape_a, shape_b, image), none twice, id of A < id of B.
 * n is the unit normal from A to B, t = (n_y, -n_x); impulses (n, t) act on B, their opposite on A; velocities are of B minus
 * A. The impulse acts on A at centre + arm_a + lever_a n, on B at centre (moved by image periods) + arm_b - lever_b n; arms
 * lead to the centre of the disk in contact, or to the touched point of any other shape (whose lever is 0). Two disks: lever =
 * radius + gap / 2. Disk and another wall: lever of the disk = radius + gap. */
typedef struct nscdd_contacts {
  uint64_t count;
  const int32_t* a; /* row of A in the poses given to detect_contacts */
  const int32_t* b;
  const int32_t* shape_a; /* numbered by the platform, stable */
  const int32_t* shape_b;
  const int32_t* image;  /* B is seen at x + image * period; null when not periodic */
  const double* gap;     /* [m], negative when the shapes overlap */
  const double* normal;  /* 2 per contact */
  const double* lever_a; /* [m] */
  const double* lever_b;
  const double* arm_a; /* 2 per contact [m]; both null when all arms are zero */
  const double* arm_b;
  const double* site;        /* 2 per contact [m]: mid-point of the two disk centres, or the touched point of another wall
                              * (the disk's centre where that is deeper than its radius behind the wall) */
  const uint8_t* flat;       /* 1: one side is flat at the contact */
  const double* friction;    /* [-] >= 0 */
  const double* restitution; /* [-] in [0, 1] */
} nscdd_contacts;

/* What a finished step gives back: the bodies that this rank owns, the contacts that it solved. */
typedef struct nscdd_step_result {
  uint64_t body_count;
  const int64_t* id;      /* ascending */
  const double* pose;     /* 3 per body, end of the step */
  const double* velocity; /* 3 per body, end of the step */
  uint64_t contact_count;
  const int64_t* contact_body;  /* 2 per contact: ids of A and B */
  const int32_t* contact_shape; /* 3 per contact: shape_a, shape_b, image */
  const double* impulse;        /* 2 per contact: (n, t) [N s] */
} nscdd_step_result;

typedef struct nscdd_host_description {
  const char* name;           /* lower case, for messages */
  const char* version;        /* of the platform behind it */
  int32_t distributed_bodies; /* 1: pack, insert and remove are there */
  int32_t prescribed_motion;  /* 1: prescribed bodies may have a velocity other than zero */
  int32_t clusters;           /* 1: free bodies may have arms */
  int32_t reserved;           /* 0 */
  double period;              /* [m] length of the periodic direction x; 0: not periodic */
  double period_origin;       /* [m] */
} nscdd_host_description;

/* The platform. Every function gets `user` first; arrays that it hands out stay valid until the next call of the same function.
 * Meaning and order of the calls: ReadBodies, DetectContacts, Commit and BodyTransport in nscdd/platform_adapter.h. */
typedef struct nscdd_host {
  nscdd_header header;
  void* user;
  int32_t (*describe)(void* user, nscdd_host_description* description);
  int32_t (*read_bodies)(void* user, nscdd_bodies* bodies);
  /* count bodies in ascending order of id, 3 numbers each; the host is not changed */
  int32_t (*detect_contacts)(void* user, uint64_t count, const int64_t* id, const double* pose, double alert_distance,
                             nscdd_contacts* contacts);
  int32_t (*commit)(void* user, const nscdd_step_result* result);
  /* null unless distributed_bodies */
  int32_t (*pack)(void* user, int64_t id, const void** bytes, uint64_t* size);
  int32_t (*insert)(void* user, int64_t id, const void* bytes, uint64_t size);
  int32_t (*remove)(void* user, int64_t id);
  /* sentence of the last function that did not return NSCDD_OK; never null */
  const char* (*last_error)(void* user);
  /* Since minor 3; may be null. Contacts on the bodies' way through a step of dt [s]: SweepContacts in
   * nscdd/platform_adapter.h. pose (at the beginning) and velocity: 3 numbers each, reach [m]: 1. *moment gets an array of
   * contacts->count numbers: the part of the step, in [0, 1], at which each contact's gap, normal, levers and arms are taken.
   * Without this function detect_contacts is asked at the beginning of the step, with the largest sum of two reaches as alert
   * distance. */
  int32_t (*sweep_contacts)(void* user, uint64_t count, const int64_t* id, const double* pose, const double* velocity,
                            const double* reach, double dt, nscdd_contacts* contacts, const double** moment);
} nscdd_host;

/* ------------------------------------------------------------------ plugin: what a solver gives to a host */

typedef enum nscdd_type { NSCDD_BOOL = 0, NSCDD_INTEGER = 1, NSCDD_REAL = 2, NSCDD_CHOICE = 3, NSCDD_GRID = 4 } nscdd_type;

/* An option of a solver. Values cross as text: true, 12, 1e-4, nat, 4x2. */
typedef struct nscdd_option {
  const char* name;
  int32_t type; /* nscdd_type */
  int32_t reserved;
  const char* default_value;
  const char* unit;    /* "-" when dimensionless */
  const char* choices; /* a|b|c of NSCDD_CHOICE, else "" */
  const char* help;    /* one line */
} nscdd_option;

typedef struct nscdd_solver_info {
  const char* name;
  const char* summary; /* one line */
  uint64_t option_count;
  const nscdd_option* options;
} nscdd_solver_info;

/* One contact problem, solved in the order of its contacts; see nscdd/contact_problem.h. */
typedef struct nscdd_problem {
  nscdd_header header;
  uint64_t body_count;
  const double* mass;          /* [kg], +inf: prescribed motion */
  const double* inertia;       /* [kg m^2] */
  const double* free_velocity; /* 3 per body */
  const double* impulse;       /* 3 per body: dt f [N s, N m s] */
  nscdd_contacts contacts;     /* a, b are rows of the arrays above; shape, image and keys are not read and may be null */
  const double* offset;        /* b_n [m/s] per contact */
  const double* warm_impulse;  /* 2 per contact, or null */
  double approach_speed;       /* [m/s] largest approach speed before the step */
} nscdd_problem;

typedef struct nscdd_solution {
  nscdd_header header;
  double* velocity;          /* caller's, 3 per body */
  double* impulse;           /* caller's, 2 per contact */
  double* relative_velocity; /* caller's, 2 per contact, or null */
} nscdd_solution;

typedef enum nscdd_status {
  NSCDD_CONVERGED = 0,
  NSCDD_ITERATION_LIMIT = 1,
  NSCDD_STALLED = 2,
  NSCDD_DIVERGED = 3,
  NSCDD_INCOMPLETE = 4, /* an incomplete resolution did all that it does; the criterion does not hold for the whole sample */
  NSCDD_FIXED = 5 /* since minor 2: tolerance 0, it made the iterations asked for. Where the header of the host's nscdd_report
                   * is of a lower minor, NSCDD_ITERATION_LIMIT stands for it */
} nscdd_status;

/* Of the last step or solve. Units and meanings: nscdd/figures.h. Members behind the header's struct_size are not written. */
typedef struct nscdd_report {
  nscdd_header header;
  int32_t status; /* nscdd_status */
  int32_t reserved;
  const char* reason; /* valid until the next call on the handle */
  int64_t step;
  double time;
  int64_t bodies;
  int64_t contacts;
  int64_t active;
  int64_t sticking;
  int64_t iterations;
  int64_t sweeps;
  double nat;
  double nat_max;
  double quad;
  double maxm;
  double qm16;
  double interface_jump;
  double relative_jump;
  int64_t worst_body_a;
  int64_t worst_body_b;
  int64_t subdomains;
  int64_t empty_subdomains;
  int64_t interface_bodies;
  int64_t interface_copies;
  int64_t max_multiplicity;
  int64_t unknowns_per_contact;
  int64_t unknowns_per_body;
  int64_t bytes_per_contact;
  int64_t bytes_per_body;
  int64_t painleve_contacts;
  double mean_interpenetration;
  double max_interpenetration;
  double mean_radius;
  double kinetic_energy;
  double momentum_x;
  double momentum_y;
  double injected_energy;
  double max_drift;
  double alert_distance;
  int64_t migrated_bodies;
  int64_t messages;
  int64_t message_bytes;
  int64_t collectives;
  double seconds_detect;
  double seconds_solve;
  double seconds_communicate;
  double seconds_total;
  int64_t interface_updates;
  int64_t cg_iterations;
  int64_t cg_failures;
  int64_t analyses;
  int64_t factorisations;
  double seconds_interface;
  int64_t extrapolations;
  int64_t acceleration_restarts; /* the last one of minors 0 to 2 */
  double power;
  double load_error;
  double wall_error;
  double imbalance;
  int64_t redetections;
  int64_t second_solves;
  int64_t beyond_reach;
  int64_t beyond_reach_body;
  int64_t unsettled;
} nscdd_report;

/* A column of a table: `count` numbers of 8 bytes each, real (double) or integer (int64_t). */
typedef struct nscdd_column {
  const char* name;
  const char* unit;
  int32_t is_integer;
  int32_t reserved;
  const void* values;
} nscdd_column;

typedef struct nscdd_table {
  nscdd_header header;
  uint64_t row_count;
  uint64_t column_count;
  const nscdd_column* columns; /* valid until the next call on the handle */
} nscdd_table;

typedef struct nscdd_solver nscdd_solver;

typedef struct nscdd_create_arguments {
  nscdd_header header;
  const nscdd_host* host; /* null: the handle only solves single problems; kept until destroy */
  int32_t communicator;   /* Fortran handle (MPI_Comm_c2f), duplicated by the plugin; read only if distributed is 1 */
  int32_t distributed;    /* 0: this process alone, MPI is not touched */
  const char* solver;     /* a name out of `solvers` */
  uint64_t option_count;
  const char* const* option_names; /* read during create only */
  const char* const* option_values;
} nscdd_create_arguments;

typedef struct nscdd_plugin {
  nscdd_header header;
  const char* name;
  const char* version;
  const char* mpi_library; /* first line of MPI_Get_library_version at build time; "" when the plugin does not use MPI */
  uint64_t solver_count;
  const nscdd_solver_info* solvers;

  /* *solver is null on failure; the sentence is then in `error` (cut to error_size bytes, always terminated). */
  int32_t (*create)(const nscdd_create_arguments* arguments, nscdd_solver** solver, char* error, uint64_t error_size);
  void (*destroy)(nscdd_solver* solver); /* null is allowed */

  int32_t (*step)(nscdd_solver* solver, double dt);
  int32_t (*solve)(nscdd_solver* solver, const nscdd_problem* problem, nscdd_solution* solution);

  int32_t (*report)(nscdd_solver* solver, nscdd_report* report);
  /* Names: "bodies" and "contacts" (this rank's, after a step), "iterations" (residuals at each test of the last solve). */
  int32_t (*table)(nscdd_solver* solver, const char* name, nscdd_table* table);

  /* What a continuation needs beside the host's bodies, this rank's part: impulses by key, interface impulses, counters.
   * load_state takes it back on as many ranks as before, each its own part. */
  int32_t (*state_size)(nscdd_solver* solver, uint64_t* size);
  int32_t (*save_state)(nscdd_solver* solver, void* bytes, uint64_t size);
  int32_t (*load_state)(nscdd_solver* solver, const void* bytes, uint64_t size);

  const char* (*last_error)(nscdd_solver* solver); /* never null; valid until the next call on the handle */

  /* Since minor 1. Continues on any number of ranks: the parts that all ranks of the earlier run saved at the same time, each
   * given to one rank; `count` of them here, maybe none. Bodies may be in the host of any rank, each in one. Nothing changes on
   * failure. */
  int32_t (*load_states)(nscdd_solver* solver, uint64_t count, const void* const* parts, const uint64_t* sizes);

  /* Since minor 3. Whether `solver`, a name out of `solvers`, takes this value of this option beside defaults of the others:
   * what create would say, without a handle. The sentence goes into `error` as in create. Not collective. */
  int32_t (*check_option)(const char* solver, const char* name, const char* value, char* error, uint64_t error_size);
} nscdd_plugin;

typedef const nscdd_plugin* (*nscdd_plugin_entry_function)(void);

#ifdef __cplusplus
}
#endif

#endif /* NSCDD_PLUGIN_H_ */
