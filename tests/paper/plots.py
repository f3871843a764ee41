# SPDX-License-Identifier: Apache-2.0
"""Curves into data files and PNG pictures, by gnuplot."""

import subprocess


def write_data(path, names, rows):
    """A table with one line of names; None becomes a gap in the curve."""
    with open(path, "w") as file:
        file.write("# " + " ".join(names) + "\n")
        for row in rows:
            file.write(" ".join("?" if value is None else f"{value:.9g}" for value in row) + "\n")


def plot(folder, name, title, x_label, panels, x_log=False):
    """Draws panels side by side. A panel: (y label, y is logarithmic, {curve: [(x, y), ...]})."""
    script = [f"set terminal pngcairo size {620 * len(panels)},480 font 'DejaVu Sans,10'", f"set output '{folder}/{name}.png'",
              f"set multiplot layout 1,{len(panels)} title '{title}'", "set grid", "set key below maxrows 2", "set bmargin 6",
              "set datafile missing '?'",
              f"set xlabel '{x_label}'"]
    for number, (y_label, y_log, curves) in enumerate(panels):
        script += ["set logscale x" if x_log else "unset logscale x", "set logscale y" if y_log else "unset logscale y",
                   "set format y '10^{%L}'" if y_log else "set format y '%g'", f"set ylabel '{y_label}'"]
        parts = []
        for index, (curve, points) in enumerate(curves.items()):
            data = f"{folder}/data/{name}_{number}_{index}.dat"
            write_data(data, ["x", curve.replace(" ", "_")], points)
            label = curve.replace("'", "''")  # as gnuplot quotes a quote
            parts.append(f"'{data}' using 1:2 with {'linespoints pt 7 ps 0.6' if x_log else 'lines'} lw 1.5 title '{label}'")
        script.append("plot " + ", ".join(parts))
    script.append("unset multiplot")
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def table(header, rows):
    """A Markdown table."""
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"
