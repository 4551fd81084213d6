"""Where Rowland is: the add-on is a link into its tree, and takes limits, presets and programs from there."""

import json
import shutil
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3]
MATERIALS = FOLDER / "content" / "materials"


def load_schema():
    """The JSON Schema of the material file."""
    file = FOLDER / "modules" / "diffraction" / "asset" / "material.schema.json"
    if not file.is_file():
        raise FileNotFoundError(f"{file} is missing: link the add-on's folder from Rowland's tree, do not copy it")
    return json.loads(file.read_text(encoding="utf-8"))


def preset_files():
    """The shipped materials, in a stable order."""
    return sorted(MATERIALS.glob("*.json"))


def find_program(name):
    """The path of one of Rowland's programs, or None."""
    built = FOLDER / "build" / "release" / "bin" / name
    return str(built) if built.is_file() else shutil.which(name)
