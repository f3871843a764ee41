# SPDX-License-Identifier: Apache-2.0
"""The rules of the project's structure, as data."""

# Parts by folder; the longest prefix wins. Tests may include anything.
PARTS = {
    "core/include": "core",
    "core/src": "core inside",
    "adapters/reference": "reference adapter",
    "adapters/box2d": "Box2D adapter",
    "adapters/conformance": "conformance suite",
    "plugin/include": "plugin interface",
    "plugin/callback": "callback adapter",
    "plugin/host": "plugin host",
    "plugin/src": "plugin",
    "plugin/runner": "runner",
    "plugin/text": "text",
}

# Where an #include "..." of a part is looked for, beside the file's own folder.
INCLUDE_FOLDERS = {
    "core": ["core/include"],
    "core inside": ["core/src"],
    "reference adapter": ["adapters/reference/include", "adapters/reference/src"],
    "Box2D adapter": ["adapters/box2d/include", "adapters/box2d/src"],
    "callback adapter": ["plugin/callback/include", "plugin/callback"],
    "conformance suite": ["adapters/conformance/include", "adapters/conformance/src"],
    "plugin interface": ["plugin/include"],
    "plugin host": ["plugin/host/include", "plugin/host"],
    "plugin": ["plugin/src", "plugin"],
    "runner": ["plugin/runner", "plugin"],
    "text": ["plugin"],
}

# What each part may include of the others.
MAY_INCLUDE = {
    "core": set(),
    "core inside": {"core"},
    "reference adapter": {"core"},
    "Box2D adapter": {"core"},
    "callback adapter": {"core", "plugin interface"},
    "conformance suite": {"core"},
    "plugin interface": set(),
    "plugin host": {"core", "plugin interface"},
    "plugin": {"core", "plugin interface", "callback adapter", "text"},
    "runner": {"core", "plugin interface", "plugin host", "reference adapter", "Box2D adapter", "text"},
    "text": set(),
}

# Floors within a part, from the lowest to the highest; the longest prefix of a path wins. An include may only run down, or stay
# on its floor: whoever reads a part from its lowest floor up never meets a name that was not explained.
FLOORS = [
    ["core/include/", "core/src/measure/", "core/src/parallel/", "core/src/linear/", "core/src/partition/", "core/src/problem/",
     "core/src/nlgs/", "core/src/interface/", "core/src/newton/", "core/src/algorithms/", "core/src/stepping/"],
    ["adapters/box2d/include/nscdd/box2d/exact_body.h", "adapters/box2d/src/",
     "adapters/box2d/include/nscdd/box2d/box2d_adapter.h", "adapters/box2d/src/box2d_adapter.cpp"],
]

# Headers of other projects that only some files may include: (what the name begins with, who may, why).
FOREIGN_HEADERS = [
    ("mpi.h",
     ("core/include/nscdd/mpi_communicator.h", "core/src/parallel/mpi_", "plugin/src/", "plugin/runner/",
      "plugin/host/mpi_library.c", "tests/"),
     "MPI reaches the method through a Communicator only"),
    ("box2d/", ("adapters/box2d/", "plugin/runner/", "tests/"), "Box2D is one platform among others"),
    ("dmumps", ("core/src/linear/mumps_", "tests/"), "MUMPS is behind the LinearSolver seam"),
    ("Eigen/", ("core/src/", "tests/"), "Eigen stays inside the core"),
]

# Solving is the plugin's business: these may see the core's tables and reports, but not its solvers.
SOLVER_HEADERS = ("nscdd/time_stepper.h", "nscdd/contact_solver.h")
THROUGH_THE_PLUGIN = ("plugin/host/", "plugin/runner/")

# Text that must not occur: (regular expression, where, where not, why).
FORBIDDEN_TEXT = [
    (r"(?i)box2d", ("core/",), (), "the core knows no platform"),
    (r"\bMPI_COMM_WORLD\b|\bMPI_(Init|Init_thread|Finalize)\(", ("core/", "adapters/", "plugin/src/"), (),
     "a library does not own MPI; the communicator is passed in"),
    (r"std::c(out|err)\b|\bf?printf\(|\bfmt::print\(", ("core/", "plugin/src/", "adapters/"),
     ("adapters/conformance/", "adapters/box2d/example/", "README.md"),
     "a library prints nothing"),
    (r"std::j?thread\b|std::async\b|\bpthread_create\b|#pragma omp\b", ("core/", "plugin/", "adapters/"), (),
     "processes share nothing; with a thread the thread sanitizer would have to run, see tests/sanitizers/README.md"),
]

TOP_LEVEL = {
    "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff", "demo.sh",
    "test.sh", "core", "plugin", "adapters", "tests", "sample_scenes",
}
TOP_LEVEL_OPTIONAL = {"findings"}  # may be missing
NOT_IN_GIT = {"build", "results", "compile_commands.json"}

PLUGIN_SYMBOLS = ["nscdd_plugin_entry"]
