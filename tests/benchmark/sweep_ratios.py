#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads benchmark_sweep's JSON (repetitions, not aggregates) and prints medians beside the bare loop, as a table in Markdown.

usage: sweep_ratios.py FILE.json
"""
import collections
import json
import statistics
import sys


def main(path):
    rates = collections.defaultdict(list)  # (law, disks, what) -> contact updates per second
    facts = {}
    with open(path, encoding="utf-8") as stream:
        for run in json.load(stream)["benchmarks"]:
            if run["run_type"] != "iteration":
                continue
            law, disks, what = run["run_name"].split("/")[:3]
            rates[law, int(disks), what].append(run["items_per_second"])
            facts[law, int(disks)] = (int(run["contacts"]), run["active"])
    print("| law | disks | contacts | active | bare loop [M/s] | sweep [M/s] | sweep / bare | with statistics / bare |"
          " nat and nat_max / bare |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for law, disks in sorted(facts):
        median = {what: statistics.median(rates[law, disks, what]) for what in ("bare", "product", "statistics", "residual")}
        contacts, active = facts[law, disks]
        ratios = " | ".join(f"{median[what] / median['bare']:.2f}" for what in ("product", "statistics", "residual"))
        print(f"| {law} | {disks} | {contacts} | {active:.0%} | {median['bare'] / 1e6:.0f} | "
              f"{median['product'] / 1e6:.0f} | {ratios} |")


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
