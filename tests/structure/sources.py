# SPDX-License-Identifier: Apache-2.0
"""Finds what is not written as all sources of the project are: licence, columns, format."""

import os
import pathlib
import re
import shutil
import subprocess

CPP = {".h", ".cpp", ".c"}
SCRIPTS = {".py", ".sh", ".cmake"}
NOT_OURS = {"build", "results", "corpus", "regressions", "__pycache__"}  # folders: made by programs
COLUMNS = 128
LICENCE = "SPDX-License-Identifier: Apache-2.0"
CLANG_FORMAT = 14  # formats change from version to version; this is Debian 12's
SKIPPED = 77


def sources(root, suffixes):
    """Paths of the files with these suffixes, and with scripts the CMakeLists.txt and those of .ci."""
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(f for f in folders if f not in NOT_OURS and (f == ".ci" or not f.startswith(".")))
        for name in sorted(names):
            path = pathlib.Path(folder, name)
            script = name == "CMakeLists.txt" or path.parent.name == ".ci"
            if path.suffix in suffixes or (script and ".py" in suffixes):
                yield path


def check_lines(root):
    """The licence is in the first two lines, and no line is too long."""
    for path in sources(root, CPP | SCRIPTS):
        where = path.relative_to(root).as_posix()
        text = path.read_text(encoding="utf-8").splitlines()
        if not any(LICENCE in line for line in text[:2]):
            yield f"{where} does not begin with '{LICENCE}', as a comment."
        for number, line in enumerate(text, 1):
            if len(line) > COLUMNS:
                yield f"{where}:{number} has {len(line)} columns; at most {COLUMNS}."


def clang_format():
    """The program clang-format of the right version, or None."""
    for name in (f"clang-format-{CLANG_FORMAT}", "clang-format"):
        program = shutil.which(name)
        if program:
            version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
            if re.search(rf"version {CLANG_FORMAT}\.", version):
                return program
    return None


def check_format(root, program):
    files = [str(p) for p in sources(root, CPP)]
    result = subprocess.run([program, "--dry-run", "--Werror", f"--style=file:{root}/.clang-format", *files],
                            capture_output=True, text=True)
    found = dict.fromkeys(re.findall(r"^(\S+?):\d+:\d+: error", result.stderr, re.MULTILINE))
    for path in found:
        yield f"{os.path.relpath(path, root)} is not formatted: run clang-format -i on it."
    if result.returncode != 0 and not found:
        yield f"clang-format failed: {result.stderr.strip()}"
