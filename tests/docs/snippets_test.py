# SPDX-License-Identifier: Apache-2.0
"""The code blocks of the documents are code. snippets_test.py NSCDD COMPILER FLAG...   (COMPILER FLAG... compiles C++)

What stands between ```LANGUAGE and ``` is
  cpp     compiled: a file as it is, or statements, which go into a function behind their #include lines. A comment before the
          block says what the reader has already: <!-- given: bool running, b2World& world -->, or that the block is lines of a
          file which is compiled elsewhere: <!-- lines of: tests/conformance/minimal_adapter.cpp -->
  cmake   lines of the file that its comment names
  python  compiled, not run
Command lines of nscdd, in indented blocks and in ``` without a language, name commands and options that there are.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- (given|lines of): (.*?) -->\n\n?)?^```(\w*)\n(.*?)^```$", re.M | re.S)
COMMAND = re.compile(r"(?:^|[\s;])nscdd ([a-z][\w-]*)([^#\n]*)")


class Block:
    def __init__(self, document, match):
        self.kind, self.note, self.language, self.text = match.groups()
        text = document.read_text(encoding="utf-8")
        self.place = f"{document.relative_to(SOURCE)}:{text[:match.start(3)].count(chr(10)) + 1}"


def documents():
    return sorted(p for p in SOURCE.rglob("*.md") if not {"build", "results", ".git"} & set(p.relative_to(SOURCE).parts))


def blocks(*languages):
    found = [Block(d, m) for d in documents() for m in BLOCK.finditer(d.read_text(encoding="utf-8"))]
    return [b for b in found if b.language in languages]


def program_of(block):
    """A translation unit from a block."""
    if re.search(r"^(int main|class|struct|namespace)\b", block.text, re.M):
        return block.text
    lines = block.text.splitlines()
    head = [line for line in lines if line.startswith("#include")]
    body = ["" if line in head else line for line in lines]
    return "\n".join(head + [f"void Snippet({block.note or ''}) {{"] + body + ["}"]) + "\n"


def plain(line):
    """A line without its comment and spaces."""
    return re.sub(r"\s+", "", re.sub(r"(//|#).*", "", line))


def command_lines(document):
    text = document.read_text(encoding="utf-8")
    shell = [b.text for b in blocks("") if b.place.startswith(str(document.relative_to(SOURCE)) + ":")]
    shell += re.findall(r"^ {4,}(\S.*)$", text, re.M)
    return [m.groups() for block in shell for line in block.splitlines() for m in COMMAND.finditer(line)]


class Snippets(unittest.TestCase):
    def test_cpp_compiles(self):
        with tempfile.TemporaryDirectory() as folder:
            for block in blocks("cpp"):
                if block.kind == "lines of":
                    continue
                with self.subTest(block.place):
                    file = pathlib.Path(folder, "snippet.cpp")
                    file.write_text(program_of(block), encoding="utf-8")
                    done = subprocess.run([*COMPILER, "-fsyntax-only", str(file)], capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode, 0, f"{block.place}\n{done.stderr}")

    def test_lines_are_those_of_their_file(self):
        for block in blocks("cpp", "cmake"):
            if block.kind != "lines of":
                self.assertNotEqual(block.language, "cmake", f"{block.place}: name the file: <!-- lines of: FILE -->")
                continue
            there = {plain(line) for line in (SOURCE / block.note).read_text(encoding="utf-8").splitlines()}
            for line in block.text.splitlines():
                with self.subTest(block.place, line=line):
                    self.assertTrue(plain(line) in there | {""}, f"{block.place}: '{line}' is not in {block.note}")

    def test_python_compiles(self):
        for block in blocks("python"):
            compile(block.text, block.place, "exec")

    def test_commands_and_options_exist(self):
        helps = {}
        seen = 0
        for document in documents():
            for command, rest in command_lines(document):
                if command not in helps:
                    helps[command] = subprocess.run([NSCDD, command, "--help"], capture_output=True, text=True, check=False)
                with self.subTest(document.name, command=command, rest=rest):
                    self.assertEqual(helps[command].returncode, 0, f"{document}: nscdd {command}")
                    for option in re.findall(r"(?<!\S)(--?[a-zA-Z][\w-]*)", rest):
                        seen += 1
                        self.assertRegex(helps[command].stdout, rf"(^|[\s,]){option}\b", f"{document}: {command} {option}")
        self.assertGreater(seen, 20)

    def test_every_language_is_known(self):
        for block in blocks(*{m[3] for d in documents() for m in BLOCK.finditer(d.read_text(encoding="utf-8"))}):
            self.assertIn(block.language, ("", "cpp", "cmake", "python", "toml", "sh"), block.place)


if __name__ == "__main__":
    NSCDD, COMPILER = sys.argv[1], sys.argv[2:]
    del sys.argv[1:]
    unittest.main()
