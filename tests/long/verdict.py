# SPDX-License-Identifier: Apache-2.0
"""What a long run must keep to: sentences with their figures, and whether they hold."""

import statistics

TREND = 1.5             # mean interpenetration of the last quarter over that of the second one
DEEPEST = 0.1           # interpenetration [mean radii]
NOT_CONVERGED = 0.01    # of the steps
CLIMB = 0.01            # rise of energy above its lowest value so far, over m g r of all grains
AT_REST = 1e-9          # kinetic energy in the last quarter, over m g r of all grains
CREEP = 1e-3            # fall of the centre of mass in the last half [mean radii]
MEMORY = 1.02, 256      # the last quarter over the second one: factor, and kB to spare


def quarters(table, name, reduce):
    count = len(table) // 4
    return [reduce([row[name] for row in table[i * count:(i + 1) * count]]) for i in range(4)]


def figures(values):
    return ", ".join(f"{value:.3g}" for value in values)


def bounds(run, table):
    """Yields (holds, sentence)."""
    steps = run.steps
    diverged, missed = (sum(row[name] for row in table) for name in ("diverged", "not_converged"))
    yield diverged == 0, f"{diverged} of {steps} steps diverged"
    yield missed <= NOT_CONVERGED * steps, f"{missed} of {steps} steps missed their tolerance (at most {NOT_CONVERGED:.0%})"
    yield run.lost() == 0, f"{run.lost()} of {len(run.grains)} grains were lost"
    mean = quarters(table, "mean_interpenetration", statistics.fmean)
    yield mean[3] <= TREND * mean[1], (f"mean interpenetration does not grow: quarters {figures(mean)} mean radii "
                                       f"(fourth over second at most {TREND})")
    deepest = quarters(table, "max_interpenetration", max)
    yield max(deepest) <= DEEPEST, f"largest interpenetration: quarters {figures(deepest)} mean radii (at most {DEEPEST})"
    yield from energy(run, table)
    drift = max(row["max_drift"] for row in table)
    yield drift <= 1, f"no grain moved further than {drift:.3g} mean radii in a step (at most 1)"
    memory = quarters(table, "resident_kB", max)
    yield memory[3] <= MEMORY[0] * memory[1] + MEMORY[1], (
        f"memory does not grow: quarters {', '.join(map(str, memory))} kB resident "
        f"(fourth over second at most {MEMORY[0]}, and {MEMORY[1]} kB)")


def energy(run, table):
    scale = run.scene.mass() * 9.81 * run.mean_radius()
    climb = [value / scale for value in quarters(table, "energy_climb", max)]
    yield max(climb) <= CLIMB, f"energy never rises by more than: quarters {figures(climb)} m g r (at most {CLIMB})"
    kinetic = quarters(table, "kinetic_energy", statistics.fmean)
    if not run.scene.rests:
        yield kinetic[3] <= TREND * kinetic[1], (
            f"mean kinetic energy does not grow: quarters {figures(k / scale for k in kinetic)} m g r "
            f"(fourth over second at most {TREND})")
        return
    yield kinetic[3] <= AT_REST * scale, (f"at rest: kinetic energy {kinetic[3] / scale:.2g} m g r in the last quarter "
                                          f"(at most {AT_REST})")
    half = len(table) // 2
    fall = (table[half]["potential_energy"] - table[-1]["potential_energy"]) / scale
    yield abs(fall) <= CREEP, (f"no creep: the centre of mass falls by {fall:.2g} mean radii in the second half "
                               f"(at most {CREEP})")
