# SPDX-License-Identifier: Apache-2.0
"""The checks themselves: a small sound tree passes, and each way to spoil it is found. structure_test.py SHARED_LIBRARY"""

import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import unittest

import rules
import sources
import structure

SOUND = {
    "core/include/nscdd/body_table.h": "#pragma once\n#include <vector>\nnamespace nscdd {\nstruct BodyTable;\n"
                                       "struct BodyTable {\n"
                                       "};\n}  // namespace nscdd\n",
    "core/include/nscdd/time_stepper.h": '#include "nscdd/body_table.h"\n',
    "core/include/nscdd/mpi_communicator.h": "#include <mpi.h>\n",
    "core/src/nlgs/sweep.h": '#include "nscdd/body_table.h"\n',
    "core/src/nlgs/sweep.cpp": '#include "nlgs/sweep.h"\n#include <Eigen/Core>\nnamespace nscdd {\nnamespace {\n'
                               'class BodyTable {};\n'
                               "}  // namespace\nclass BodyTable::Row {\n};\n}  // namespace nscdd\n",
    "core/src/parallel/mpi_communicator.cpp": '#include "nscdd/mpi_communicator.h"\n#include <mpi.h>\n',
    "adapters/box2d/src/store.cpp": '#include <box2d/box2d.h>\n#include "nscdd/body_table.h"\n',
    "core/src/stepping/stepper.h": '#include "nlgs/sweep.h"\n',
    "core/src/nlgs/local_solve.h": '#include "nlgs/sweep.h"\n',
    "adapters/box2d/include/nscdd/box2d/box2d_adapter.h": '#include "nscdd/box2d/exact_body.h"\n',
    "adapters/box2d/include/nscdd/box2d/exact_body.h": "",
    "adapters/box2d/src/box2d_adapter.cpp": '#include "nscdd/box2d/box2d_adapter.h"\n',
    "plugin/callback/callback.cpp": '#include "nscdd_plugin.h"\n#include "nscdd/body_table.h"\n',
    "plugin/callback/include/nscdd/callback/callback.h": "",
    "plugin/include/nscdd_plugin.h": "#include <stdint.h>\n",
    "plugin/host/include/nscdd/host/solver.h": '#include "nscdd_plugin.h"\n',
    "plugin/src/entry.cpp": '#include "nscdd/callback/callback.h"\n#include "nscdd/time_stepper.h"\n',
    "plugin/runner/main.cpp": '#include "nscdd/host/solver.h"\n#include "nscdd/body_table.h"\n#include <mpi.h>\n',
    "tests/unit/any_test.cpp": '#include "nlgs/sweep.h"\n#include <mpi.h>\n',
}

# File, line to add, what the finding says.
SPOILED = [
    ("core/src/nlgs/sweep.cpp", '#include "nscdd/callback/callback.h"', "not callback adapter"),
    ("core/src/nlgs/sweep.cpp", '#include "nscdd_plugin.h"', "not plugin interface"),
    ("core/src/nlgs/sweep.cpp", "#include <mpi.h>", "through a Communicator"),
    ("core/src/nlgs/sweep.cpp", "#include <dmumps_c.h>", "LinearSolver seam"),
    ("core/src/nlgs/sweep.cpp", "// as in BOX2D", "knows no platform"),
    ("core/src/nlgs/sweep.cpp", 'std::cout << "here";', "prints nothing"),
    ("plugin/runner/main.cpp", "std::thread helper(Work);", "processes share nothing"),
    ("core/src/nlgs/sweep.cpp", '#include "nlgs/lost.h"', "in no part of the project"),
    ("plugin/runner/main.cpp", "namespace nscdd {\nstruct BodyTable final {};\n}  // namespace nscdd", "one type, one name"),
    ("core/src/parallel/mpi_communicator.cpp", "auto world = MPI_COMM_WORLD;", "does not own MPI"),
    ("core/include/nscdd/body_table.h", '#include "nlgs/sweep.h"', "not core inside"),
    ("core/include/nscdd/body_table.h", "#include <Eigen/Core>", "stays inside the core"),
    ("core/include/nscdd/body_table.h", "#include <nscdd/time_stepper.h>", 'write "..."'),
    ("adapters/box2d/src/store.cpp", '#include "nscdd_plugin.h"', "not plugin interface"),
    ("adapters/box2d/src/store.cpp", '#include "nlgs/sweep.h"', "not core inside"),
    ("plugin/callback/callback.cpp", '#include "nscdd/host/solver.h"', "not plugin host"),
    ("plugin/callback/callback.cpp", "#include <box2d/box2d.h>", "one platform among others"),
    ("plugin/src/entry.cpp", '#include "nlgs/sweep.h"', "not core inside"),
    ("core/src/nlgs/sweep.cpp", '#include "stepping/stepper.h"', "core/src/nlgs/ is a lower floor than core/src/stepping/"),
    ("adapters/box2d/src/store.cpp", '#include "nscdd/box2d/box2d_adapter.h"', "upstairs"),
    ("plugin/src/entry.cpp", '#include "nscdd/host/solver.h"', "not plugin host"),
    ("plugin/runner/main.cpp", '#include "nscdd/time_stepper.h"', "through the loaded plugin"),
    ("plugin/runner/main.cpp", '#include "nlgs/sweep.h"', "not core inside"),
    ("notes.txt", "", "notes.txt lies in the project's root"),
]


class StructureTest(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        for name in rules.TOP_LEVEL:
            if "." in name or name == "LICENSE":
                (self.root / name).write_text("")
            else:
                (self.root / name).mkdir()
        for name, text in SOUND.items():
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            (self.root / name).write_text(text)

    def test_a_sound_tree_passes(self):
        self.assertEqual(structure.check_tree(self.root), [])

    def test_each_fault_is_found(self):
        for name, line, sentence in SPOILED:
            with self.subTest(name=name, line=line):
                file = self.root / name
                before = file.read_text() if file.exists() else None
                file.write_text((before or "") + line + "\n")
                findings = structure.check_tree(self.root)
                self.assertEqual(len(findings), 1, findings)
                self.assertIn(sentence, findings[0])
                self.assertIn(name, findings[0])
                if before is None:
                    file.unlink()
                else:
                    file.write_text(before)

    def test_what_is_optional_may_lie_in_the_root(self):
        for name in rules.TOP_LEVEL_OPTIONAL:
            (self.root / name).mkdir()
        self.assertEqual(structure.check_tree(self.root), [])

    def test_a_missing_file_is_found(self):
        (self.root / "LICENSE").unlink()
        self.assertEqual(structure.check_tree(self.root), ["LICENSE is missing in the project's root."])

    def test_unusual_sources_are_found(self):
        licence = f"// {sources.LICENCE}\n"
        file = self.root / "core/src/nlgs/sweep.cpp"
        for path in sources.sources(self.root, sources.CPP | sources.SCRIPTS):
            path.write_text(licence if path != file else licence + "/" * sources.COLUMNS + "\n")
        self.assertEqual(list(sources.check_lines(self.root)), [])
        file.write_text(licence + "/" * (sources.COLUMNS + 1) + "\n")
        self.assertEqual(list(sources.check_lines(self.root)), ["core/src/nlgs/sweep.cpp:2 has 129 columns; at most 128."])
        file.write_text(licence)
        (self.root / ".ci").mkdir()
        for name in ("core/src/nlgs/sweep.cpp", "CMakeLists.txt", "test.sh", ".ci/run", "tests/unit/new_test.py"):
            before = (self.root / name).read_text() if (self.root / name).exists() else licence
            (self.root / name).write_text("int x;\n")
            findings = list(sources.check_lines(self.root))
            self.assertEqual(len(findings), 1, findings)
            self.assertIn(f"{name} does not begin with", findings[0])
            (self.root / name).write_text(before)

    @unittest.skipIf(sources.clang_format() is None, "no clang-format")
    def test_unformatted_sources_are_found(self):
        (self.root / ".clang-format").write_text("BasedOnStyle: Google\n")
        for path in sources.sources(self.root, sources.CPP):
            path.write_text("int x;\n")
        self.assertEqual(list(sources.check_format(self.root, sources.clang_format())), [])
        (self.root / "core/src/nlgs/sweep.cpp").write_text("int  x;\nint  y;\n")
        self.assertEqual(list(sources.check_format(self.root, sources.clang_format())),
                         ["core/src/nlgs/sweep.cpp is not formatted: run clang-format -i on it."])

    def test_other_symbols_are_found(self):
        findings = list(structure.check_plugin_symbols(SHARED_LIBRARY))
        self.assertEqual(len(findings), 1)
        self.assertIn("must export nscdd_plugin_entry alone", findings[0])
        self.assertIn("nm cannot read", next(structure.check_plugin_symbols(__file__)))

    @unittest.skipIf(platform.machine() not in ("x86_64", "AMD64"), "other instructions")
    def test_fused_and_shared_code_is_found(self):
        source, wide = self.root / "wide.cpp", self.root / "wide.o"
        source.write_text("inline int Shared() { return 1; }\nint (*keep)() = Shared;\n"
                          "double Fused(double a, double b, double c) { return __builtin_fma(a, b, c); }\n")
        subprocess.run(["c++", "-O2", "-mfma", "-c", source, "-o", wide], check=True)
        findings = sorted(structure.check_wide_object(wide))
        self.assertEqual(len(findings), 2, findings)
        self.assertIn("Shared", findings[0])
        self.assertIn("vfmadd", findings[1])


if __name__ == "__main__":
    SHARED_LIBRARY = sys.argv.pop(1)
    unittest.main()
