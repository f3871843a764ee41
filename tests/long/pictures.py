# SPDX-License-Identifier: Apache-2.0
"""The digests as curves, by gnuplot."""

import subprocess

PANELS = (("mean interpenetration [mean radii]", "mean_interpenetration"),
          ("largest interpenetration [mean radii]", "max_interpenetration"),
          ("kinetic energy [J]", "kinetic_energy"), ("sweeps a step", "sweeps"), ("resident memory [MB]", "resident_kB"))


def draw(folder, names):
    """long_runs.png: panels above each other, a curve for each scene."""
    script = ["set terminal pngcairo size 800,1000 font 'DejaVu Sans,9'", f"set output '{folder}/long_runs.png'",
              "set datafile separator ','", f"set multiplot layout {len(PANELS)},1", "set grid", "set key outside right top",
              "set lmargin 10", "set rmargin 22", "set logscale y", "set format y '10^{%L}'"]
    for title, column in PANELS:
        if column == "sweeps":
            script += ["unset logscale y", "set format y '%g'", "set yrange [0:]"]
        scale = " / 1024" if column == "resident_kB" else ""
        if title == PANELS[-1][0]:
            script.append("set xlabel 'step'")
        curves = [f"'{folder}/{name}.csv' using (column('step')):(column('{column}'){scale}) with lines lw 1 "
                  f"title '{name}' noenhanced" for name in names]
        script += [f"set title '{title}' offset 0,-0.7", "plot " + ", ".join(curves)]
    script.append("unset multiplot")
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)
