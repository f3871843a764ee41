#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts one fault after the other into a copy of this checkout, builds it and runs the tests: each fault must be caught.

    tests/mutation/mutate.py                          # all of faults.toml
    tests/mutation/mutate.py --only polar_cone no_clip
    tests/mutation/mutate.py --check                  # does the list still apply to the sources? No build.

Exit code 1 if a fault survives, 2 if the list, the build or the tests without a fault are wrong.
"""

import argparse
import pathlib
import sys
import tempfile
import time

from fault import LIST, FaultError, check, read_faults
from result import Result, commit_of, summary, write_table
from suite import LEFT_OUT, run_tests
from work_copy import BuildError, WorkCopy

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these faults")
    parser.add_argument("--list", action="store_true", help="print the faults and end")
    parser.add_argument("--check", action="store_true", help="see that each old text is once in its file, and end")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="compilers at a time (default 1)")
    parser.add_argument("--preset", default="release", help="of CMakePresets.json (default release)")
    parser.add_argument("--timeout", type=int, default=60, metavar="S",
                        help="for an expected test, five times as much for another; a fault that makes a test hang is caught "
                             "by it (default 60)")
    parser.add_argument("--work", type=pathlib.Path, metavar="DIR",
                        help="folder of the copy, kept with its build for the next time (default: a temporary one)")
    parser.add_argument("--expected-only", action="store_true", help="run no others where the expected tests miss it")
    parser.add_argument("--out", type=pathlib.Path, metavar="FILE", help="write the table of results into it, below its mark")
    return parser.parse_args()


def choose(faults, names):
    if not names:
        return faults
    unknown = sorted(set(names) - {fault.name for fault in faults})
    if unknown:
        raise FaultError(f"{LIST.name} has no fault named {', '.join(unknown)}: see --list.")
    return [fault for fault in faults if fault.name in names]


def is_in(name):
    return not LEFT_OUT.search(name)


def expect_sound(copy, faults, timeout):
    """Without a fault, the tests that are expected to catch one pass."""
    verdict = run_tests(copy, lambda name: is_in(name) and any(fault.expects(name) for fault in faults), timeout)
    if verdict.test:
        raise FaultError(f"test {verdict.test} fails without any fault: mend it first.")
    print(f"{verdict.count} expected tests pass without a fault", flush=True)


def build_with(copy, fault, outputs=()):
    try:
        copy.build(outputs)
    except BuildError as error:
        raise FaultError(f"fault {fault.name} of {LIST.name} does not compile:\n{error}") from None


def try_fault(copy, fault, outputs, timeout, expected_only):
    """The expected tests, and where they miss it all the others."""
    start = time.monotonic()
    copy.spoil(fault)
    try:
        build_with(copy, fault, outputs)
        verdict = run_tests(copy, lambda name: is_in(name) and fault.expects(name), timeout)
        if not verdict.test and not expected_only:
            build_with(copy, fault)
            verdict = run_tests(copy, lambda name: is_in(name) and not fault.expects(name), 5 * timeout)
            if verdict.test:
                expect_sound_alone(copy, fault, verdict.test, timeout)
    finally:
        copy.restore(fault)
    return Result(fault, verdict.test, verdict.timed_out, time.monotonic() - start)


def expect_sound_alone(copy, fault, test, timeout):
    copy.restore(fault)
    copy.build()
    if run_tests(copy, lambda name: name == test, 5 * timeout).test:
        raise FaultError(f"test {test} fails with fault {fault.name} and without it: mend it first.")


def run(options, faults, folder):
    start = time.monotonic()
    commit = commit_of(SOURCE)
    copy = WorkCopy(SOURCE, folder.resolve(), options.preset, options.jobs)
    copy.update()
    try:
        copy.configure()
        copy.build()
    except BuildError as error:
        raise FaultError(f"the checkout does not build without a fault:\n{error}") from None
    print(f"built in {folder}, {time.monotonic() - start:.0f} s", flush=True)
    tests = copy.tests()
    outputs = {fault.name: copy.outputs_for(fault, tests) for fault in faults}
    expect_sound(copy, faults, options.timeout)
    results = []
    for fault in faults:
        results.append(try_fault(copy, fault, outputs[fault.name], options.timeout, options.expected_only))
        print(results[-1].line(), flush=True)
    print(summary(results))
    if options.out:
        write_table(options.out, results, commit, time.monotonic() - start)
    return 0 if all(result.caught_by for result in results) else 1


def main():
    options = parse_arguments()
    faults = choose(read_faults(), options.only)
    if options.list:
        for fault in faults:
            print(f"{fault.name:28} {fault.file}: {fault.what}")
        return 0
    wrong = list(check(faults, SOURCE))
    if wrong or options.check:
        print("\n".join([*wrong, f"{len(faults)} faults, {len(wrong)} do not apply"]))
        return 2 if wrong else 0
    if options.work:
        options.work.mkdir(parents=True, exist_ok=True)
        return run(options, faults, options.work)
    with tempfile.TemporaryDirectory(prefix="nscdd_mutation_") as folder:
        return run(options, faults, pathlib.Path(folder))


if __name__ == "__main__":
    try:
        sys.exit(main())
    except FaultError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
