# SPDX-License-Identifier: Apache-2.0
"""What became of each fault, as lines and as the table of README.md."""

import dataclasses
import datetime
import subprocess

MARK = "<!-- Everything below is written by mutate.py --out. -->"


@dataclasses.dataclass
class Result:
    fault: object
    caught_by: str  # name of a test; empty: nobody
    timed_out: bool
    seconds: float

    def line(self):
        caught = f"caught by {self.caught_by}" if self.caught_by else "NOT CAUGHT"
        return f"{self.fault.name:28} {caught}{' (time-out)' if self.timed_out else ''}, {self.seconds:.0f} s"

    def row(self):
        caught = f"`{self.caught_by}`" if self.caught_by else "**nobody**"
        what = self.fault.what.replace("|", "\\|")
        return (f"| `{self.fault.name}`: {what} | {self.fault.file} | "
                f"{caught}{', by its time-out' if self.timed_out else ''} |")


def git(source, *arguments):
    return subprocess.run(["git", *arguments], cwd=source, capture_output=True, text=True, check=True).stdout.strip()


def commit_of(source):
    is_changed = git(source, "status", "--porcelain") != ""
    return git(source, "rev-parse", "--short", "HEAD") + (" with local changes" if is_changed else "")


def summary(results):
    caught = sum(1 for result in results if result.caught_by)
    late = sum(1 for result in results if result.timed_out)
    return f"{len(results)} faults, {caught} caught ({late} by a time-out), {len(results) - caught} not"


def write_table(path, results, commit, seconds):
    """Replaces what is below the mark of a file, or makes the file."""
    head = path.read_text(encoding="utf-8").partition(MARK)[0] if path.exists() else ""
    lines = [f"{summary(results)}: {datetime.date.today().isoformat()}, commit {commit}, {seconds / 60:.0f} minutes.", "",
             "| fault | file | caught by |", "| --- | --- | --- |", *(result.row() for result in results)]
    path.write_text(head + MARK + "\n\n" + "\n".join(lines) + "\n", encoding="utf-8")
