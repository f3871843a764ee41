# SPDX-License-Identifier: Apache-2.0
"""check.py tree|lines|format ROOT, check.py plugin FILE.so, check.py wide FILE.o   prints what breaks the structure (tree,
plugin), what an object for one instruction set must not have (wide), or what is not written as the sources are (lines, format);
exit code 1 if anything does, 77 without clang-format."""

import pathlib
import sys

import sources
import structure


def check_format(root):
    program = sources.clang_format()
    if program is None:
        print(f"skipped: there is no clang-format {sources.CLANG_FORMAT}; Debian's package is clang-format")
        sys.exit(sources.SKIPPED)
    return sources.check_format(root, program)


CHECKS = {
    "tree": structure.check_tree,
    "plugin": structure.check_plugin_symbols,
    "wide": structure.check_wide_object,
    "lines": lambda root: sources.check_lines(pathlib.Path(root)),
    "format": check_format,
}


def main(kind, target):
    findings = list(CHECKS[kind](target))
    for finding in findings:
        print(finding)
    print(f"{len(findings)} findings in {target}")
    return 1 if findings else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in CHECKS:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
