#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""fronts.py FOLDER   prints, from the CSV files of fronts.sh, a section a scene: its front, Box2D beside it,
and when IEA pays."""

import csv
import pathlib
import sys

UNSOUND = {"failed", "cut", "diverged"}
NUMBERS = ("seconds", "nat", "nat_max", "velocity_error", "interpenetration_mean", "interpenetration_max", "solver_growth_max",
           "sweeps",
           "exchanges", "observable_error")


def read(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key in NUMBERS:
            row[key] = float(row[key]) if row[key] else None
    return rows


def front(rows, key):
    """Rows that no other beats in (seconds, key), the cheapest first."""
    kept = []
    for row in sorted((r for r in rows if r["status"] not in UNSOUND and r[key] is not None),
                      key=lambda r: (r["seconds"], r[key])):
        if not kept or row[key] < kept[-1][key]:
            kept.append(row)
    return kept


def as_good(row, other):
    return row["nat"] <= other["nat"] and row["interpenetration_max"] <= other["interpenetration_max"]


def cheapest_as_good(rows, other, cost="seconds"):
    good = [r for r in rows if r["status"] not in UNSOUND and as_good(r, other)]
    return min(good, key=lambda r: r[cost], default=None)


def ms(row):
    return f"{1e3 * row['seconds']:.3g}"


def print_table(head, rows):
    print("\n| " + " | ".join(head) + " |")
    print("|" + " --- |" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def print_front(rows, key, title):
    cells = [[r["setting"], r["status"], ms(r), f"{r['sweeps']:.0f}", f"{r['exchanges']:.0f}", f"{r['nat']:.1e}",
              f"{r['nat_max']:.1e}",
              f"{r['velocity_error']:.1e}" if r["velocity_error"] is not None else "", f"{r['interpenetration_mean']:.1e}",
              f"{r['interpenetration_max']:.1e}", f"{r['solver_growth_max']:.1e}"] for r in front(rows, key)]
    print(f"{title}:")
    print_table(["setting", "status", "ms a step", "sweeps", "exchanges", "nat", "nat_max", "V error", "interpenetration, mean",
                 "largest", "largest growth by the solver"], cells)


def print_box2d(runs):
    ours = [r for r in runs if r["solver"] != "box2d"]
    cells = []
    for box in (r for r in runs if r["solver"] == "box2d" and r["status"] not in UNSOUND):
        best = cheapest_as_good(ours, box)
        cells.append([box["setting"], ms(box), f"{box['nat']:.1e}", f"{box['interpenetration_max']:.1e}",
                      best["setting"] if best else "none", ms(best) if best else "",
                      f"{box['seconds'] / best['seconds']:.2f}" if best else ""])
    if not cells:
        print("Box2D's own solver does not take this scene.\n")
        return
    print("For each setting of Box2D the cheapest of ours that is at least as good in nat and in largest interpenetration:")
    print_table(["Box2D", "ms", "nat", "largest interpenetration", "ours", "ms", "times faster"], cells)


def grid_of(row):
    options = dict(o.split("=", 1) for o in row["options"].split(";") if "=" in o)
    return options.get("subdomains", "1x1")


def print_iea(runs):
    """A single augmented problem a step against iterations of accelerated NSCDD on the same grid."""
    cells = []
    for iea in (r for r in runs if r["solver"] == "iea" and r["status"] not in UNSOUND):
        same = [r for r in runs if r["solver"] == "nscdd" and "anderson" in r["options"] and grid_of(r) == grid_of(iea)]
        best = cheapest_as_good(same, iea)
        cells.append([iea["setting"], ms(iea), f"{iea['exchanges']:.0f}", f"{iea['nat']:.1e}",
                      f"{iea['interpenetration_max']:.1e}",
                      best["setting"] if best else "none", ms(best) if best else "",
                      f"{best['exchanges']:.0f}" if best else ""])
    if cells:
        print("IEA beside the cheapest accelerated NSCDD on its grid that is at least as good:")
        print_table(["IEA", "ms", "exchanges", "nat", "largest interpenetration", "NSCDD", "ms", "exchanges"], cells)


def main(folder):
    print("# Fronts\n\nMade by `tests/benchmark/fronts.sh`. Lengths in mean radii; columns: README.md.\n")
    for path in sorted(pathlib.Path(folder).glob("*.csv")):
        rows = read(path)
        runs = [r for r in rows if r["view"] == "runs"]
        problems = [r for r in rows if r["view"] == "problems"]
        print(f"## {path.stem}\n\n![error against cost]({path.stem}.png)\n")
        unsound = [f"{r['setting']} ({r['view']}: {r['status']})" for r in rows if r["status"] in UNSOUND]
        if unsound:
            print(f"Not ranked: {', '.join(unsound)}.\n")
        print_front(problems, "velocity_error", "The same problems, front of the velocity error")
        print_front(runs, "nat", "Runs, front of nat")
        print_front(runs, "interpenetration_max", "Runs, front of the largest interpenetration")
        print_box2d(runs)
        print_iea(runs)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
