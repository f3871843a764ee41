#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reproduces the paper "augmented interface problem" (Visseq, Alart, Dureisseix): its figures, its table, and a verdict on
each claim.

    tests/paper/study.py [--quick] [--out results/paper] [--nscdd build/release/bin/nscdd] [--only figure3 ...]

Writes REPORT.md, pictures and data into the folder. --quick takes fewer values of lambda and less than three minutes on
two cores.
"""

import argparse
import pathlib
import platform
import time

import claims
import figures
import tables
from runs import FLOW, SCENES, Program, find_program, need_gnuplot

PARTS = ("figure3", "process", "figure7", "figure9", "table1", "updates", "cg", "stability", "correction", "cost")


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor()


def make_report(program, out, quick, parts):
    """Sections of the report, in order; yields (title, text) as soon as each is done."""
    rows = []
    if "figure3" in parts:
        rows += claims.about_one_step(figures.one_step(program, out, quick))
        yield "Figure 3: one step", ("![figure 3](figure3.png)\n\nFEA: It1. REA: It2 + It3. "
                                     "One sweep per stage, QM/16 at 1.666e-4.\n")
    if "process" in parts:
        rows += claims.about_the_process(figures.process(program, out, quick))
        yield "Figures 5 and 6: rotating gravity", "![figure 5](figure5.png)\n\n![figure 6](figure6.png)\n"
    if "figure7" in parts:
        runs = figures.incomplete(program, out, quick, "figure7", SCENES[0.3], 50, "IEA, rotating gravity, mu = 0.3", save=True)
        rows += claims.about_incomplete(runs, "rotating gravity")
        figures.pictures(program, out, runs, "figure8", "IEA 1000")
        yield "Figures 7 and 8: the incomplete resolution", (
            "![figure 7](figure7.png)\n\nOverlaps of at least 0.9 of the largest in red, "
            "lambda = 1e3:\n\n![first step](figure8_step1.png) ![last step](figure8_step50.png)\n")
    if "figure9" in parts:
        steps = 40 if quick else 200
        runs = figures.incomplete(program, out, quick, "figure9", FLOW, steps, "IEA, periodic flow", save=True)
        rows += claims.about_incomplete(runs, "flow")
        figures.pictures(program, out, runs, "figure10", "IEA 1000")
        yield "Figures 9 and 10: the flow", (f"![figure 9](figure9.png)\n\n![first step](figure10_step1.png) "
                                             f"![last step](figure10_step{steps}.png)\n")
    if "table1" in parts:
        yield "Table 1: seconds", (claims.about_table1(figures.table1(program, quick))
                                   + "\nEA3 is IEA with the embedded conjugate gradient.\n")
    if rows:
        yield "The paper's claims", claims.claims_table(rows)
    for name, title, make in (("updates", "Interface updates to nat 1e-3 / 1e-4", tables.updates),
                              ("cg", "CG iterations of one interface solve: none / diagonal / lumped / Dirichlet",
                               tables.preconditioners),
                              ("stability", "Stability in lambda: one cold step", tables.stability),
                              ("correction", "Correction of interpenetration in IEA", tables.correction),
                              ("cost", "Cost of an interface update", tables.cost)):
        if name in parts:
            yield title, make.__doc__ + "\n\n" + make(program, quick).lstrip("\n")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--quick", action="store_true", help="fewer values, less than three minutes")
    arguments.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/paper"), help="folder of the report")
    arguments.add_argument("--nscdd", help="the program (default: the release build's)")
    arguments.add_argument("--only", nargs="+", choices=PARTS, default=None, help="some parts only")
    options = arguments.parse_args()
    need_gnuplot()
    program = Program(find_program(options.nscdd), options.out.resolve())
    (program.out / "data").mkdir(parents=True, exist_ok=True)
    parts = options.only or (PARTS[:5] if options.quick else PARTS)
    start = time.monotonic()
    sections = []
    for title, text in make_report(program, program.out, options.quick, parts):
        sections.append(f"## {title}\n\n{text}")
        head = (f"# The augmented interface problem, reproduced\n\n"
                f"`tests/paper/study.py{' --quick' if options.quick else ''}` on "
                f"{processor()}, {program.count} runs, {time.monotonic() - start:.0f} s. "
                "Choices where the paper is silent: radii in "
                f"[0.7, 1.3] m, density 1 kg/m^2, g 9.81, dt 0.01 s, QM/16 at 1.666e-4 tested every iteration, grid 1x2.\n\n")
        (program.out / "REPORT.md").write_text(head + "\n".join(sections))
    print(f"\n{program.out}/REPORT.md")


if __name__ == "__main__":
    main()
