# SPDX-License-Identifier: Apache-2.0
"""What the paper did not measure: the enriched interface with several sweeps per stage, the conjugate gradient's
preconditioners, stability in lambda, the correction of interpenetration, and what an update costs."""

from plots import table
from runs import SCENES

SAMPLE = SCENES[0.3]


ACCELERATED = {"acceleration": "anderson", "jump_guard": "true"}


def updates(program, quick):
    """Interface updates to nat 1e-3 / 1e-4, one cold step, over sweeps per stage, lambda and grid; plain, then accelerated."""
    grids, counts, lambdas = (["1x2", "8x8"], [1, 5], [10]) if quick else (["1x2", "4x4", "8x8"], [1, 5, 25], [10, 100, 1000])
    text = ""
    for mu, scene, how, extra in [(*item, *kind) for item in SCENES.items()
                                  for kind in (("plain", {}), ("Anderson", ACCELERATED))]:
        rows = []
        for grid in grids:
            for n_gs in counts:
                row = [f"{grid}, {n_gs}"]
                for value in [0] + lambdas:
                    cells = []
                    for tolerance in ("1e-3", "1e-4"):
                        run = program.run(scene, "fea", steps=1, cold=True, subdomains=grid, sweeps_per_stage=n_gs,
                                          tolerance=tolerance,
                                          criterion="nat", test_every=1, max_iterations=4500 if value == 0 else 2500, **extra,
                                          **{"lambda": value})
                        cells.append(f"{run.last('iterations'):.0f}" if run.last("status") == "converged" else "-")
                    row.append(" / ".join(cells))
                rows.append(row)
        text += f"\nmu = {mu}, {how}\n\n" + table(["grid, n_GS", "nscdd"] + [f"lambda {v:g}" for v in lambdas], rows)
    return text


def preconditioners(program, quick):
    """Iterations of one interface solve by the conjugate gradient to 1e-6, in step 5, when the contacts that carry
    are known."""
    grids, lambdas = (["1x2", "4x4"], [1, 100]) if quick else (["1x2", "2x2", "4x4", "8x8"], [1, 100, 1e4, 1e6])
    rows = []
    for grid in grids:
        row = [grid]
        for value in lambdas:
            found = []
            for preconditioner in ("none", "diagonal", "lumped", "dirichlet"):
                run = program.run(SAMPLE, "iea", steps=5, subdomains=grid, interface="cg", preconditioner=preconditioner,
                                  cg_tolerance="1e-6", cg_max_iterations=20000, max_iterations=200, **{"lambda": value})
                found.append(f"{run.last('cg_iterations'):.0f}")
            row.append(" / ".join(found))
        rows.append(row)
    return table(["subdomains"] + [f"lambda {v:g}" for v in lambdas], rows)


def stability(program, quick):
    """Status, updates and nat of one cold step: FEA with 5 sweeps per stage, plain; accelerated and guarded (default);
    nat of IEA."""
    lambdas = [0, 10, 1e4, 1e8] if quick else [0, 1, 10, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8]
    text = ""
    for mu, scene in SCENES.items():
        rows = []
        for value in lambdas:
            row = [f"{value:g}"]
            for grid in ("1x2", "4x4", "8x8"):
                fea = program.run(scene, "fea", steps=1, cold=True, subdomains=grid, tolerance="1e-4", max_iterations=2000,
                                  **{"lambda": value})
                own = program.run(scene, "fea", steps=1, cold=True, subdomains=grid, tolerance="1e-4", max_iterations=2000,
                                  **ACCELERATED, **{"lambda": value})
                iea = program.run(scene, "iea", steps=1, cold=True, subdomains=grid, tolerance="1e-4", **{"lambda": value})
                ends = [f"{run.last('status')} {run.last('iterations'):.0f} ({run.last('nat'):.0e})" for run in (fea, own)]
                row.append("; ".join(ends) + f"; iea {iea.last('nat'):.0e}")
            rows.append(row)
        text += f"\nmu = {mu}\n\n" + table(["lambda", "1x2", "4x4", "8x8"], rows)
    return text


def correction(program, quick):
    """Final mean / largest interpenetration of IEA with the two ways to undo it: in the law, or in the linear step only."""
    ways = {"none": {}, "law 0.05": {"normal_law": "feedback", "feedback_beta": 0.05},
            "law 0.2": {"normal_law": "feedback", "feedback_beta": 0.2}, "linear step 0.05": {"restoring": 0.05},
            "linear step 0.2": {"restoring": 0.2}, "closing 20 updates": {"closing_updates": 20}}
    rows = []
    for value in [100] if quick else [10, 100, 1e4]:
        for name, options in ways.items():
            run = program.run(SAMPLE, "iea", subdomains="1x2", **options, **{"lambda": value})
            rows.append([f"{value:g}", name, f"{run.last('mean_interpenetration'):.1e}",
                         f"{run.largest('max_interpenetration'):.1e}",
                         f"{run.mean('sweeps'):.0f}", f"{run.total('injected_energy'):.2g}"])
    return table(["lambda", "correction", "final mean [m]", "largest [m]", "sweeps a step", "injected energy bound [J]"], rows)


def cost(program, quick):
    """A sweep of all contacts; a mean update in a step of FEA, and how many of 299 factorised anew; the one update
    of a step of IEA."""
    rows = []
    for scene, grid in ((SAMPLE, "1x2"),) if quick else ((SAMPLE, "1x2"), (SAMPLE, "4x4"), ("box_10k", "4x4")):
        steps = 1
        sweep = program.run(scene, "nscdd", steps=steps, cold=True, subdomains=grid, test_every=1000, max_iterations=1000,
                            tolerance=0)
        row = [scene, grid, f"{1e3 * sweep.total('seconds_solve') / sweep.total('sweeps'):.3f}"]
        for interface in ("direct", "cg"):
            # The first update of a step factorises; with a frozen active set all the others only solve.
            many = program.run(scene, "fea", steps=steps, cold=True, subdomains=grid, interface=interface, sweeps_per_stage=1,
                               test_every=1000, max_iterations=300, tolerance=0, **{"lambda": 1})
            few = program.run(scene, "iea", steps=5, subdomains=grid, interface=interface, max_iterations=1, **{"lambda": 1})
            row += [f"{1e3 * many.total('seconds_interface') / many.total('interface_updates'):.3f} "
                    f"({many.total('factorisations'):.0f} of {many.total('interface_updates'):.0f} factorised)",
                    f"{1e3 * few.total('seconds_interface') / few.total('interface_updates'):.3f}"]
        rows.append(row)
    return table(["scene", "subdomains", "sweep [ms]", "direct, FEA [ms]", "direct, once a step [ms]", "cg, FEA [ms]",
                  "cg, once a step [ms]"],
                 rows)
