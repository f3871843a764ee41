# SPDX-License-Identifier: Apache-2.0
"""The paper's claims, each with the numbers of this run and whether they bear it out."""

import statistics

from plots import table


def _verdict(holds):
    return "reproduced" if holds else "NOT reproduced"


def _iterations(found):
    return {value: f["its"] for value, f in found.items() if f["its"] is not None}


def about_one_step(result):
    rows = []
    for mu, r in result.items():
        fea, rea = r["fea"]["G'"], r["rea"]["G'"]
        rows.append((f"mu {mu}: NSCDD needs about the iterations of NSCD", f"{r['nscd']:.0f} and {r['nscdd']:.0f}",
                     _verdict(abs(r["nscdd"] / r["nscd"] - 1) < 0.1)))
        small = [f["it2"] for v, f in rea.items() if v <= 1]
        rows.append((f"mu {mu}: It2 is constant for lambda < 1", " / ".join(f"{x:.0f}" for x in small),
                     _verdict(max(small) < 1.1 * min(small))))
        its, first = _iterations(fea), fea[0.0]["its"]
        rows.append((f"mu {mu}: It2 < It1", f"{rea[0.0]['it2']:.0f} < {first:.0f} at lambda 0",
                     _verdict(rea[0.0]["it2"] < first)))
        middle = [its.get(v) for v in fea if 1 < v < 100]
        falls = all(x is not None and x < first for x in middle)
        rows.append((f"mu {mu}: fewer iterations for 1 < lambda < 100",
                     ", ".join(f"{v:g}: {its.get(v, float('nan')):.0f}" for v in fea if 1 < v <= 100) + f" (from {first:.0f})",
                     _verdict(falls)))
        large = {v: f for v, f in fea.items() if v > 500}
        ended = ", ".join("{:g}: {}".format(v, f["status"]) for v, f in large.items())
        rows.append((f"mu {mu}: diverges for lambda > 500", ended, _verdict(all(f["its"] is None for f in large.values()))))
        both = [(v, _iterations(rea)[v], its[v]) for v in fea if v in its and v in _iterations(rea)]
        rows.append((f"mu {mu}: It2 + It3 < It1", ", ".join(f"{v:g}: {b:.0f} < {a:.0f}" for v, b, a in both),
                     _verdict(all(b < a for _, b, a in both))))
        if "G" in r["fea"]:
            good = {name: len(_iterations(r["fea"][name])) for name in ("G'", "G")}
            rows.append((f"mu {mu}: G' is the more robust compatibility",
                         f"converges at {good[chr(71) + chr(39)]} and {good['G']} of "
                         f"{len(fea)} lambdas", _verdict(good["G'"] >= good["G"])))
    return rows


def about_the_process(result):
    rows = []
    for mu, runs in result.items():
        base = runs["NSCDD"].mean("iterations")
        for name, run in runs.items():
            if name in ("NSCD", "NSCDD"):
                continue
            rows.append((f"mu {mu}: {name} brings no significant reduction over the process",
                         f"{run.mean('iterations'):.0f} iterations a step, NSCDD {base:.0f}; final mean interpenetration "
                         f"{run.last('mean_interpenetration'):.1e} and {runs['NSCDD'].last('mean_interpenetration'):.1e} m",
                         _verdict(run.mean("iterations") > 0.8 * base)))
    return rows


def about_incomplete(runs, test):
    ours = {name: run for name, run in runs.items() if name.startswith("IEA")}
    names = list(ours)
    first, last = ours[names[0]], ours[names[-1]]
    base = runs["NSCDD"]
    means = ", ".join(f"{n[4:]}: {r.last('mean_interpenetration'):.1e}" for n, r in ours.items())
    maxima = ", ".join(f"{n[4:]}: {r.largest('max_interpenetration'):.1e}" for n, r in ours.items())
    middle = [r.mean("iterations") for r in ours.values()]
    return [
        (f"{test}: IEA needs moderately fewer iterations than NSCDD",
         f"{min(middle):.0f} to {max(middle):.0f} local sweeps a step, NSCDD "
         f"{base.mean('iterations'):.0f}", _verdict(statistics.fmean(middle) < base.mean("iterations"))),
        (f"{test}: the mean interpenetration falls with lambda", means,
         _verdict(last.last("mean_interpenetration") < 0.5 * first.last("mean_interpenetration"))),
        (f"{test}: it stays above NSCDD's", f"at best {min(r.last('mean_interpenetration') for r in ours.values()):.1e}, NSCDD "
         f"{base.last('mean_interpenetration'):.1e} m",
         _verdict(min(r.last("mean_interpenetration") for r in ours.values()) > base.last("mean_interpenetration"))),
        (f"{test}: the largest interpenetration stays acceptable beside the mean radius 1", maxima,
         _verdict(max(r.largest("max_interpenetration") for n, r in ours.items() if n != names[0]) < 0.05)),
    ]


def about_table1(seconds):
    paper = {"NSCD": 117, "NSCDD": 63, "EA3, lambda 0": 46, "EA3, lambda 1e+06": 51}
    base = seconds[("NSCD", 1)]
    rows = []
    for (name, ranks), time in seconds.items():
        rows.append((name, ranks, f"{time:.2f}", f"{time / base:.2f}", paper.get(name, ""),
                     f"{paper[name] / 117:.2f}" if name in paper else ""))
    return table(["algorithm", "ranks", "seconds here", "ratio to NSCD", "paper's seconds", "paper's ratio"], rows)


def claims_table(rows):
    return table(["claim", "figures of this run", "verdict"], rows)
