# SPDX-License-Identifier: Apache-2.0
"""500 rows out of the rows of a run."""

import csv
import statistics

DT, ROWS = 0.01, 500


def make(run):
    """Rows of blocks of steps: name -> number. Lengths are in mean radii, energies in J, `time` is at the end of the block.

    Potential energy is minus the work of gravity, g . (P + P') / 2 dt in each step: theta is 1/2, so it is exact, gravity may
    turn and the period needs no care. Walls are fixed: but for the solver's residual and the scheme, energy falls.
    `energy_climb` is how far it rose above its lowest value so far.
    """
    block = max(1, run.steps // ROWS)
    potential = lowest = px = py = 0.0
    radius = run.mean_radius()
    table, rows, sample = [], [], 0
    for row in run.rows:
        k = int(row["step"])
        gx, gy = run.scene.gravity(k)
        x, y = float(row["momentum_x"]), float(row["momentum_y"])
        potential -= 0.5 * DT * (gx * (px + x) + gy * (py + y))
        px, py = x, y
        energy = float(row["kinetic_energy"]) + potential
        lowest = min(lowest, energy)
        rows.append((row, energy - lowest))
        if k % block == 0 or k == run.steps:
            while sample + 1 < len(run.samples) and run.samples[sample + 1][0] <= k:
                sample += 1
            memory = run.samples[sample][1] if run.samples else 0
            table.append(summary(rows, radius) | {"potential_energy": potential, "resident_kB": memory})
            rows = []
    return table


def summary(rows, radius):
    def numbers(name):
        return [float(row[name]) for row, _ in rows]

    last = rows[-1][0]
    status = [row["status"] for row, _ in rows]
    return {"step": int(last["step"]), "time": float(last["time"]),
            "kinetic_energy": statistics.fmean(numbers("kinetic_energy")),
            "largest_kinetic_energy": max(numbers("kinetic_energy")),
            "potential_energy": 0.0, "energy_climb": max(climb for _, climb in rows),
            "mean_interpenetration": statistics.fmean(numbers("mean_interpenetration")) / radius,
            "max_interpenetration": max(numbers("max_interpenetration")) / radius,
            "contacts": round(statistics.fmean(numbers("contacts"))), "sweeps": statistics.fmean(numbers("sweeps")),
            "not_converged": sum(s != "converged" for s in status), "diverged": status.count("diverged"),
            "max_drift": max(numbers("max_drift")) / radius, "resident_kB": 0}


def write(path, table):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table[0])
        for row in table:
            writer.writerow(value if isinstance(value, int) else f"{value:.5g}" for value in row.values())
