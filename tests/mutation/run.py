#!/usr/bin/env python3
"""Breaks one line of the code at a time and looks whether the quick tests notice.

usage: tests/mutation/run.py [--check] [--first-only] [--part K/N] [--work FOLDER] [WORD...]

  WORD          only faults whose description or file contains one of the words
  --check       only look whether each fault's text and test programs occur in the tree
  --first-only  run the programs that a fault names, and not all quick tests if those pass
  --part K/N    every Nth fault, from the Kth
  --work FOLDER where the scratch copy is built (build/mutation); a later run continues there

For each fault of faults.txt: a line "killed by SUITE...", "killed by the build" or "SURVIVED". Then a table: of each suite
of those programs its seconds, under how many faults it ran, how many it killed, and how many no other one did. Exit code
1 if a fault survived, 2 if the list does not fit the tree.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Fault:
    def __init__(self, text):
        lines = text.strip().splitlines()
        self.description = " ".join(line[2:] for line in lines if line.startswith("# "))
        place, programs = next(line for line in lines if re.match(r"[\w./]+: ", line)).split(": ")
        self.programs = programs.split()
        self.before = next(line[2:] for line in lines if line.startswith("- "))
        self.after = next(line[2:] for line in lines if line.startswith("+ "))
        self.occurrence = int(next((line[11:] for line in lines if line.startswith("occurrence ")), 0))
        self.file = place

    def find_file(self, tree):
        """The file; where it has moved, the only one of its name."""
        if (tree / self.file).exists():
            return tree / self.file
        tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        name = pathlib.PurePath(self.file).name
        moved = [line for line in tracked.splitlines() if pathlib.PurePath(line).name == name]
        if len(moved) != 1:
            raise ValueError(f"{self.file}: no such file")
        return tree / moved[0]

    def broken(self, content):
        count = content.count(self.before)
        if count == 0 or (count > 1 and not 1 <= self.occurrence <= count):
            raise ValueError(f"{self.file}: {count} times, expected once: {self.before}")
        at = -1
        for _ in range(max(self.occurrence, 1)):
            at = content.index(self.before, at + 1)
        return content[:at] + self.after + content[at + len(self.before):]


def read_faults(words):
    blocks = re.split(r"\n\s*\n", (pathlib.Path(__file__).parent / "faults.txt").read_text())
    faults = [Fault(block) for block in blocks if "\n- " in block]
    return [fault for fault in faults
            if not words or any(word in fault.description or word in fault.file for word in words)]


def test_programs(tree):
    lists = tree.glob("tests/**/CMakeLists.txt")
    return {name for file in lists for name in re.findall(r"rowland_test\((\w+)", file.read_text())}


def misfits(faults, tree):
    found = []
    programs = test_programs(tree)
    for fault in faults:
        found += [f"{fault.file}: no test program {name}" for name in fault.programs if name not in programs]
        try:
            fault.broken(fault.find_file(tree).read_text())
        except ValueError as error:
            found.append(str(error))
    return found


class Scratch:
    """A copy of the tracked files, built with the preset release."""

    def __init__(self, folder):
        self.tree = folder / "tree"
        self.build = self.tree / "build" / "release"
        self.tree.mkdir(parents=True, exist_ok=True)
        tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        for name in filter(None, tracked.split("\0")):
            source, copy = ROOT / name, self.tree / name
            if source.exists() and not (copy.exists() and copy.read_bytes() == source.read_bytes()):
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)  # with a new date: what it changes is built again
        data = folder / "shared"
        if not data.exists() and (ROOT.parent / "shared").exists():
            data.symlink_to(ROOT.parent / "shared")
        if not (self.build / "build.ninja").exists():
            self.run(["cmake", "--preset", "release"])

    def run(self, command):
        return subprocess.run(command, cwd=self.tree, capture_output=True, text=True)

    def builds(self, targets):
        return self.run(["cmake", "--build", str(self.build), "--target", *targets]).returncode == 0

    def results(self, arguments):
        """Of each quick test: its name, its seconds and whether it did not fail; a skipped one did not."""
        record = self.build / "mutation.xml"
        record.unlink(missing_ok=True)
        self.run(["ctest", "--test-dir", str(self.build), "-LE", "^slow$", "-j", "2", "--output-junit", str(record), *arguments])
        if not record.exists():
            return [("a program that cannot list its tests", 0, False)]
        cases = xml.etree.ElementTree.parse(record).getroot().iter("testcase")
        return [(case.get("name"), float(case.get("time")), case.get("status") != "fail") for case in cases]

    def verdict(self, fault, first_only, suites):
        if not self.builds(fault.programs):
            return "killed by the build"
        results = self.results(["-L", "^(" + "|".join(fault.programs) + ")$"])
        failed = [name for name, _, passed in results if not passed]
        for name, seconds, _ in results:
            suites.setdefault(name, Suite()).count(seconds, name in failed, failed == [name])
        if not failed and not first_only:
            self.builds(["all"])
            failed = [name for name, _, passed in self.results(["--stop-on-failure"]) if not passed]
        return "killed by " + ", ".join(failed) if failed else "SURVIVED"


class Suite:
    """What one suite has learned."""

    def __init__(self):
        self.ran = self.killed = self.alone = 0
        self.seconds = float("inf")

    def count(self, seconds, killed, alone):
        self.ran += 1
        self.killed += killed
        self.alone += alone
        self.seconds = min(self.seconds, seconds)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n", 1)[1])
    parser.add_argument("words", nargs="*")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--first-only", action="store_true")
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build" / "mutation")
    options = parser.parse_args()
    part, parts = map(int, options.part.split("/"))
    faults = read_faults(options.words)[part - 1::parts]
    wrong = misfits(faults, ROOT)
    for line in wrong:
        print(f"error: {line}", file=sys.stderr)
    if wrong:
        return 2
    if options.check:
        print(f"{len(faults)} faults fit the tree")
        return 0
    scratch = Scratch(options.work)
    survived = 0
    suites = {}
    for fault in faults:
        path = fault.find_file(scratch.tree)
        content = path.read_text()
        path.write_text(fault.broken(content))
        try:
            verdict = scratch.verdict(fault, options.first_only, suites)
        finally:
            path.write_text(content)
        survived += verdict == "SURVIVED"
        print(f"{fault.file}: {fault.description} {verdict}", flush=True)
    print(f"{len(faults) - survived} of {len(faults)} killed")
    print("suite, seconds, ran, killed, killed alone")
    for name, suite in sorted(suites.items(), key=lambda item: -item[1].seconds):
        print(f"{name}, {suite.seconds:.1f}, {suite.ran}, {suite.killed}, {suite.alone}")
    return 1 if survived else 0


sys.exit(main())
