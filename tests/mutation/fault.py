# SPDX-License-Identifier: Apache-2.0
"""The faults of faults.toml, each a text in a file and what it becomes."""

import dataclasses
import pathlib
import re
import tomllib

LIST = pathlib.Path(__file__).resolve().parent / "faults.toml"


class FaultError(Exception):
    """A sentence: which fault, in which file, and what to mend."""


@dataclasses.dataclass(frozen=True)
class Fault:
    name: str
    file: str
    old: str
    new: str
    what: str
    tests: str  # expected to catch it, a regular expression as for ctest -R

    def expects(self, test):
        return re.search(self.tests, test) is not None

    def spoiled(self, text):
        """The file's text with the fault in it."""
        count = text.count(self.old)
        if count == 0:
            raise FaultError(f"{self.file} no longer has the old text of fault {self.name}: adapt it in faults.toml.")
        if count > 1:
            raise FaultError(f"{self.file} has the old text of fault {self.name} {count} times: make it longer in faults.toml.")
        return text.replace(self.old, self.new)


def fault_from(entry):
    wanted = {field.name for field in dataclasses.fields(Fault)}
    name = entry.get("name", "without a name")
    if set(entry) != wanted:
        raise FaultError(f"fault {name} of {LIST.name} has the keys {sorted(entry)}: it needs {sorted(wanted)}.")
    fault = Fault(**entry)
    if fault.old == fault.new:
        raise FaultError(f"fault {name} of {LIST.name} changes nothing: its old and new text are the same.")
    try:
        re.compile(fault.tests)
    except re.error as error:
        raise FaultError(f"fault {name} of {LIST.name}: its tests are no regular expression: {error}.") from None
    return fault


def read_faults(path=LIST):
    with open(path, "rb") as file:
        faults = [fault_from(entry) for entry in tomllib.load(file)["fault"]]
    names = [fault.name for fault in faults]
    for name in names:
        if names.count(name) > 1:
            raise FaultError(f"{path.name} has {names.count(name)} faults named {name}: names are unique.")
    return faults


def check(faults, root):
    """One sentence for each fault that does not apply to the sources at `root`."""
    for fault in faults:
        try:
            fault.spoiled((root / fault.file).read_text(encoding="utf-8"))
        except FileNotFoundError:
            yield f"{fault.file} of fault {fault.name} does not exist: adapt it in {LIST.name}."
        except FaultError as error:
            yield str(error)
