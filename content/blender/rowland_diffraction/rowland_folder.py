"""The location of Rowland: the add-on is a link into its tree and takes limits, presets and programs from there."""

import json
import shutil
import subprocess
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3]
MATERIALS = FOLDER / "content" / "materials"


def load_schema(kind="material"):
    """The JSON Schema of a kind of source, from the program that reads it."""
    program = find_program("rowland-cook")
    if program is None:
        raise FileNotFoundError("rowland-cook is missing: build Rowland, and link the add-on's folder from its tree")
    printed = subprocess.run([program, "schema", kind], check=True, capture_output=True)
    return json.loads(printed.stdout)


def preset_files():
    """The shipped gratings, in a stable order."""
    return sorted(file for file in MATERIALS.glob("*.json") if "grating" in json.loads(file.read_text()))


def find_program(name):
    """The path of one of Rowland's programs, or None."""
    built = FOLDER / "build" / "release" / "bin" / name
    return str(built) if built.is_file() else shutil.which(name)
