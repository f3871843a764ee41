# SPDX-License-Identifier: Apache-2.0
"""Finds what breaks the rules of rules.py; every finding is a sentence that names the file, the line and the rule."""

import os
import pathlib
import re
import subprocess

import rules

SOURCES = {".h", ".cpp", ".c"}
TEXTS = SOURCES | {".txt", ".cmake", ".in", ".md", ".map", ".py", ".sh"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
NAMESPACE = re.compile(r"^namespace(?: ([\w:]+))? \{$")
TYPE = re.compile(r"^(?:struct|class|enum(?: class)?) ([\w:]+)[^;{]*(?:\{|$)")


def part_of(path):
    """The part that a path (relative, with slashes) belongs to; None for tests and the like."""
    matches = [folder for folder in rules.PARTS if path.startswith(folder + "/")]
    return rules.PARTS[max(matches, key=len)] if matches else None


def files(root, suffixes):
    for top in ("core", "adapters", "plugin", "tests"):
        for folder, _, names in os.walk(root / top):
            for name in sorted(names):
                path = pathlib.Path(folder, name)
                if path.suffix in suffixes:
                    yield path, path.relative_to(root).as_posix()


def lines(path):
    return enumerate(path.read_text(encoding="utf-8").splitlines(), 1)


def find_include(root, path, part, name):
    """Part and relative path of the file that #include "name" means: beside it, in its own part, then in any other."""
    others = [p for p in rules.INCLUDE_FOLDERS if p != part]
    folders = [path.parent] + [root / f for p in [part, *others] for f in rules.INCLUDE_FOLDERS[p]]
    for folder in folders:
        if (folder / name).is_file():
            found = (folder / name).resolve().relative_to(root.resolve()).as_posix()
            return part_of(found), found
    return None, None


def floor_of(path):
    """(number of the tower, floor in it, the floor's name) of a path; None where no floors are told."""
    matches = [(len(name), tower, floor, name) for tower, floors in enumerate(rules.FLOORS)
               for floor, name in enumerate(floors) if path.startswith(name)]
    return max(matches)[1:] if matches else None


def check_floor(where, found):
    here, there = floor_of(where), floor_of(found)
    if here and there and here[0] == there[0] and there[1] > here[1]:
        yield f"{where} includes {found}, which is upstairs: {here[2]} is a lower floor than {there[2]}."


def check_own_include(root, path, where, name):
    part = part_of(where)
    if part is None:
        return
    target, found = find_include(root, path, part, name)
    if found is None:
        yield f'{where} includes "{name}", which is in no part of the project: write <...> for headers of others.'
    elif target != part and target not in rules.MAY_INCLUDE[part]:
        allowed = ", ".join(sorted(rules.MAY_INCLUDE[part])) or "nothing"
        yield f"{where} includes {found}: {part} may include {allowed} beside itself, not {target}."
    else:
        yield from check_floor(where, found)
    if name in rules.SOLVER_HEADERS and where.startswith(rules.THROUGH_THE_PLUGIN):
        yield f"{where} includes {name}: {part} solves through the loaded plugin only."


def check_foreign_include(where, name):
    for prefix, allowed, why in rules.FOREIGN_HEADERS:
        if name.startswith(prefix) and not where.startswith(allowed):
            yield f"{where} includes <{name}>, which only {', '.join(allowed)} may: {why}."


def check_includes(root):
    for path, where in files(root, SOURCES):
        for number, line in lines(path):
            match = INCLUDE.match(line)
            if not match:
                continue
            yield from check_foreign_include(f"{where}:{number}", match[2])
            if match[1] == '"':
                yield from check_own_include(root, path, where, match[2])
            elif match[2].startswith("nscdd"):
                yield f'{where}:{number} includes <{match[2]}>: write "..." for our own headers.'


def types(path):
    """(line, qualified name) of the types defined in the namespaces of a file, but not those of one file alone."""
    inside = []
    for number, line in lines(path):
        if match := NAMESPACE.match(line):
            inside.append(match[1] or "")
        elif line.startswith("}  // namespace"):
            inside.pop()
        elif (match := TYPE.match(line)) and inside and "" not in inside:
            yield number, "::".join([*inside, match[1]])


def check_types(root):
    """Two types of one name in one program share constructors and destructors, by whichever the linker meets first."""
    first = {}
    for path, where in files(root, {".h", ".cpp"}):
        for number, name in types(path):
            if first.setdefault(name, where) != where:
                yield f"{where}:{number} defines {name}, as {first[name]} does: one type, one name."


def check_text(root):
    for path, where in files(root, TEXTS):
        for pattern, places, exceptions, why in rules.FORBIDDEN_TEXT:
            if not where.startswith(places) or any(e in where for e in exceptions):
                continue
            for number, line in lines(path):
                match = re.search(pattern, line)
                if match:
                    yield f"{where}:{number} says '{match[0]}': {why}."


def check_top_level(root):
    names = {p.name for p in root.iterdir() if not p.name.startswith(".")} - rules.NOT_IN_GIT
    allowed = rules.TOP_LEVEL | rules.TOP_LEVEL_OPTIONAL
    for name in sorted(names - allowed):
        yield f"{name} lies in the project's root, which holds only {', '.join(sorted(allowed))} and dot files."
    for name in sorted(rules.TOP_LEVEL - names):
        yield f"{name} is missing in the project's root."


def check_plugin_symbols(plugin):
    result = subprocess.run(["nm", "--dynamic", "--defined-only", "--format=posix", plugin], capture_output=True, text=True)
    if result.returncode != 0:
        yield f"nm cannot read {plugin}: {result.stderr.strip()}"
        return
    symbols = sorted(line.split()[0] for line in result.stdout.splitlines() if line)
    if symbols != rules.PLUGIN_SYMBOLS:
        yield f"{plugin} exports {', '.join(symbols) or 'nothing'}; it must export {', '.join(rules.PLUGIN_SYMBOLS)} alone."


def check_wide_object(path):
    """An object of one instruction set: it fuses nothing, and gives away no function that other objects may share."""
    code = subprocess.run(["objdump", "--disassemble", "--no-show-raw-insn", path], capture_output=True, text=True)
    names = subprocess.run(["nm", "--format=posix", path], capture_output=True, text=True)
    if code.returncode != 0 or names.returncode != 0:
        yield f"objdump and nm cannot read {path}: {(code.stderr + names.stderr).strip()}"
        return
    fused = sorted(set(re.findall(r"\tv?fn?m(?:add|sub)\w*", code.stdout)))
    if fused:
        yield f"{path} has fused operations, other bits than the plain loop: {', '.join(f.strip() for f in fused)}."
    for line in names.stdout.splitlines():
        name, kind = line.split()[:2]
        if kind in "VWu" and name != "_GLOBAL_OFFSET_TABLE_":
            yield f"{path} defines {name} for whoever links it first, also for processors that lack its instructions."


def check_tree(root):
    root = pathlib.Path(root)
    return [*check_includes(root), *check_types(root), *check_text(root), *check_top_level(root)]
