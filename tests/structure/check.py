# SPDX-License-Identifier: Apache-2.0
"""check.py tree ROOT | check.py plugin FILE.so   prints what breaks the project's structure; exit code 1 if anything does."""

import sys

import structure


def main(kind, target):
    findings = structure.check_tree(target) if kind == "tree" else list(structure.check_plugin_symbols(target))
    for finding in findings:
        print(finding)
    print(f"{len(findings)} findings in {target}")
    return 1 if findings else 0


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("tree", "plugin"):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
