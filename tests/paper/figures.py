# SPDX-License-Identifier: Apache-2.0
"""The paper's figures and its table, one function each: runs, plots, and the numbers that the claims need."""

import statistics

from plots import plot
from runs import FLOW, QM16, SCENES

GRID = {"subdomains": "1x2"}
COMPATIBILITIES = {"normal": "G'", "full": "G"}


def one_step(program, folder, quick):
    """Figure 3: one cold step at pi/8, iterations over lambda; FEA: It1, REA: It2 + It3."""
    lambdas = [0.1, 1, 10, 100, 1000] if quick else [0.1, 0.3, 1, 3, 10, 30, 100, 300, 500, 1000, 1e4, 1e6]
    limit = 6000
    result = {}
    for mu, scene in SCENES.items():
        base = {s: program.run(scene, s, steps=1, cold=True, **QM16, **({} if s == "nscd" else GRID))
                for s in ("nscd", "nscdd")}
        result[mu] = {"nscd": base["nscd"].last("iterations"), "nscdd": base["nscdd"].last("iterations"), "fea": {}, "rea": {}}
        for compatibility, name in COMPATIBILITIES.items():
            if compatibility == "full" and (quick or mu == 0.0):
                continue  # frictionless contacts have no tangential column here: G and G' are the same
            for solver, extra in (("fea", {"max_iterations": limit}),
                                  ("rea", {"max_iterations": limit, "max_interface_updates": limit})):
                found = result[mu][solver].setdefault(name, {})
                for value in [0.0] + lambdas:
                    run = program.run(scene, solver, steps=1, cold=True, sweeps_per_stage=1, compatibility=compatibility,
                                      **QM16, **GRID,
                                      **{"lambda": value}, **extra)
                    good = "iteration_limit" not in run.statuses() and "diverged" not in run.statuses()
                    its = run.last("iterations")
                    it2 = min(its, run.last("interface_updates") + (1 if solver == "rea" else 0))
                    found[value] = {"its": its if good and its < limit else None, "it2": it2, "status": run.last("status"),
                                    "nat": run.last("nat")}
    panels = []
    for mu in SCENES:
        curves = {}
        for solver in ("fea", "rea"):
            for name, found in result[mu][solver].items():
                curves[f"{solver.upper()}, {name}"] = [(v, f["its"]) for v, f in found.items() if v > 0]
        for solver in ("nscd", "nscdd"):
            curves[solver.upper()] = [(v, result[mu][solver]) for v in lambdas]
        panels.append((f"iterations, mu = {mu}", False, curves))
    plot(folder, "figure3", "One step: iterations over lambda", "lambda", panels, x_log=True)
    return result


def process(program, folder, quick):
    """Figures 5 and 6: iterations and interpenetration over the 50 steps, without and with friction."""
    result = {}
    for mu, scene in SCENES.items():
        runs = {"NSCD": program.run(scene, "nscd", **QM16), "NSCDD": program.run(scene, "nscdd", **QM16, **GRID)}
        for value in [10] if quick else [10, 100]:
            for solver in ("fea", "rea"):
                if mu == 0.0 and value > 10:
                    limit = 1500  # they cycle there; the status says so
                else:
                    limit = 6000
                extra = {"max_interface_updates": limit} if solver == "rea" else {}
                runs[f"{solver.upper()} {value}"] = program.run(scene, solver, sweeps_per_stage=1, max_iterations=limit, **QM16,
                                                                **GRID,
                                                                **{"lambda": value}, **extra)
        panels = [(label, log, {name: list(zip(run.column("step"), run.column(key))) for name, run in runs.items()})
                  for label, log, key in (("iterations", False, "iterations"),
                                          ("mean interpenetration [m]", True, "mean_interpenetration"),
                                          ("max interpenetration [m]", True, "max_interpenetration"))]
        plot(folder, "figure5" if mu == 0.0 else "figure6", f"Rotating gravity, mu = {mu}", "step", panels)
        result[mu] = runs
    return result


def incomplete(program, folder, quick, name, scene, steps, title, save=False):
    """Figures 7 and 9: the incomplete resolution over lambda."""
    lambdas = [0, 10, 1000, 1e5] if quick else [0, 1, 10, 100, 1e3, 1e4, 1e5]
    runs = {"NSCD": program.run(scene, "nscd", steps=steps, **QM16),
            "NSCDD": program.run(scene, "nscdd", steps=steps, **QM16, **GRID)}
    for value in lambdas:
        runs[f"IEA {value:g}"] = program.run(scene, "iea", steps=steps, save_every=steps if save else None, **QM16, **GRID,
                                             **{"lambda": value})
    panels = [(label, log, {n: list(zip(run.column("step"), run.column(key))) for n, run in runs.items()})
              for label, log, key in (("iterations", False, "iterations"),
                                      ("mean interpenetration [m]", True, "mean_interpenetration"),
                                      ("max interpenetration [m]", True, "max_interpenetration"))]
    plot(folder, name, title, "step", panels)
    return runs


def pictures(program, folder, runs, name, label):
    """Figures 8 and 10: first and last step, bodies by multiplicity, deep overlaps in red."""
    for step in (1, int(runs[label].last("step"))):
        program.render(runs[label], step, "overlap", folder / f"{name}_step{step}.png")


def table1(program, quick):
    """Table 1: seconds of the whole process, medians; EA3 is IEA with the embedded conjugate gradient."""
    repeats = 1 if quick else 5
    cases = [("NSCD", 0, "nscd", {}), ("NSCDD", 0, "nscdd", GRID), ("NSCDD", 2, "nscdd", GRID)]
    for value in (0, 1e6):
        for ranks in (0, 2):
            cases.append((f"EA3, lambda {value:g}", ranks, "iea", dict(GRID, interface="cg", **{"lambda": value})))
    seconds = {(name, max(1, ranks)): [] for name, ranks, _, _ in cases}
    for _ in range(repeats):
        for name, ranks, solver, options in cases:
            run = program.run(SCENES[0.3], solver, ranks=ranks, **dict(QM16, test_every=5), **options)
            seconds[(name, max(1, ranks))].append(run.total("seconds_total"))
    return {case: statistics.median(times) for case, times in seconds.items()}
