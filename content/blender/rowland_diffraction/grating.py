"""A grating as the JSON object of ROWLAND_materials_diffraction. Knows nothing of Blender."""

import copy
import json
import math
import os
from pathlib import Path

from . import rowland_folder

EXTENSION = "ROWLAND_materials_diffraction"

MEMBERS = rowland_folder.load_schema()["properties"]
METALS = MEMBERS["metal"]["enum"]
# Members of a grating with grooves of one direction; the other alternative is a lattice.
GROOVES = next(one["properties"] for one in MEMBERS["grating"]["oneOf"] if "pitch_nm" in one["properties"])

# Each profile's members and their schemas, by the profile's name. Titles and defaults are those of the inspector.
PROFILES = {
    profile["properties"]["type"]["const"]: {
        name: member for name, member in profile["properties"].items() if name != "type"
    }
    for profile in GROOVES["profile"]["oneOf"]
}

# Initial lobes, with a representation that draws them on any mesh.
LOBES = {
    "flat": ("flat", {"representation": "arc", "bands": 8, "rank": 12}),
    "sigma": ({"sigma": 0.1}, {"representation": "streak"}),
    "pits": ({"pits": {"length_nm": 850, "coherent": 0.5}}, {"representation": "planar"}),
    "pit_sequence": ({"pit_sequence": {"spacings_nm": list(range(900, 3301, 300))}}, {"representation": "planar"}),
}

# Linear colours of the metals, for the viewport alone.
METAL_COLOURS = {
    "Al": (0.91, 0.92, 0.92), "Ag": (0.97, 0.96, 0.91), "Au": (1.0, 0.77, 0.34), "Cu": (0.95, 0.64, 0.54),
}


def from_preset(file):
    """The extension's object for a material file, as `rowland-cook attach` writes it, but with absolute paths."""
    file = Path(file)
    grating = json.loads(file.read_text(encoding="utf-8"))
    grating.pop("base", None)
    move_files(grating, lambda name: os.path.normpath(file.parent.absolute() / name))
    return grating


def move_files(grating, moved):
    """Replaces the names of files in the object by moved(name)."""
    profile = grating.get("grating", {}).get("profile", {})
    if "file" in profile:
        profile["file"] = moved(profile["file"])
    quality = grating.get("quality", {})
    if quality.get("illuminant", "").endswith(".csv"):
        quality["illuminant"] = moved(quality["illuminant"])
    for i, probe in enumerate(quality.get("probes", [])):
        if isinstance(probe, dict):
            probe["image"] = moved(probe["image"])
        else:
            quality["probes"][i] = moved(probe)


def relative_to(folder):
    """The function for move_files() that makes absolute paths relative to the folder."""
    return lambda name: os.path.relpath(name, folder).replace(os.sep, "/")


def value_at(grating, path, otherwise=None):
    for key in path:
        if not isinstance(grating, dict) or key not in grating:
            return otherwise
        grating = grating[key]
    return grating


def set_value(grating, path, value):
    """Sets the value, or removes it if it is None."""
    for key in path[:-1]:
        grating = grating.setdefault(key, {})
    if value is None:
        grating.pop(path[-1], None)
    else:
        grating[path[-1]] = value


def drop_impossible_theory(grating):
    """Removes the theory unless the grating is a relief of a metal or of a sheet, and not drawn by streak."""
    grooves = grating.get("grating", {})
    relief = value_at(grooves, ("profile", "type")) in ("lamellar", "sinusoidal", "blazed")
    solved = relief and ("metal" in grating or "transmission" in grating)
    if not solved or value_at(grating, ("quality", "representation")) == "streak":
        grooves.pop("theory", None)


def set_metal(grating, metal):
    set_value(grating, ("metal",), metal)
    drop_impossible_theory(grating)


def is_lattice(grating):
    return value_at(grating, ("grating", "lattice")) is not None


def cell_text(grating):
    """The sides of a lattice's cell, as text for the panel."""
    sides = [math.hypot(*grating["grating"]["lattice"][side]) for side in ("a_nm", "b_nm")]
    return "Lattice of {:g} x {:g} nm".format(*sides)


def lattice_fields(grating):
    """The numbers of a lattice's profile that the panel shows."""
    profile = grating["grating"]["profile"]
    return [name for name in ("width_nm", "height_nm", "depth_nm") if name in profile]


def set_pitch(grating, pitch_nm, keeps_orders):
    """Sets the pitch. Unless the user chose the orders (keeps_orders), they become all that the pitch has."""
    set_value(grating, ("grating", "pitch_nm"), pitch_nm)
    if not keeps_orders:
        grating["grating"]["orders"] = "all"


def orders_text(grating):
    orders = value_at(grating, ("grating", "orders"), [-2, -1, 1, 2])
    return " ".join(map(str, orders)) if isinstance(orders, list) else str(orders)


def set_orders(grating, text):
    """Sets the orders: "all", or whole numbers, of a lattice the largest. Other text changes nothing."""
    if text.strip() == "all" and not is_lattice(grating):
        grating["grating"]["orders"] = "all"
        return
    try:
        orders = sorted({int(word) for word in text.replace(",", " ").split()})
    except ValueError:
        return
    if is_lattice(grating):
        grating["grating"]["orders"] = min(max(orders[-1], 1), 50) if orders else 1
    elif orders:
        grating["grating"]["orders"] = orders


def lobe_kind(grating):
    lobe = value_at(grating, ("grating", "groove_lobe"), "flat")
    return lobe if isinstance(lobe, str) else next(iter(lobe))


def set_lobe_kind(grating, kind):
    lobe, quality = LOBES[kind]
    set_value(grating, ("grating", "groove_lobe"), copy.deepcopy(lobe))
    grating["quality"] = dict(quality)
    drop_impossible_theory(grating)


def set_profile_kind(grating, kind):
    old = value_at(grating, ("grating", "profile"), {})
    members = {name: old.get(name, member.get("default", "")) for name, member in PROFILES[kind].items()}
    if kind == "slit" and "width_nm" not in old:  # at most the pitch
        members["width_nm"] = min(members["width_nm"], value_at(grating, ("grating", "pitch_nm"), 1600) / 2)
    set_value(grating, ("grating", "profile"), {"type": kind, **members})
    if kind == "table":  # its efficiencies include metal and dye
        grating.pop("metal", None)
        grating.get("cover", {}).pop("tint", None)
    if kind != "slit":
        grating["grating"].pop("normalization", None)
    drop_impossible_theory(grating)


def set_transmits(grating, transmits):
    set_value(grating, ("transmission",), {"ior": 1.5} if transmits else None)
    if transmits:  # a sheet has neither
        grating.pop("metal", None)
        grating.pop("cover", None)
    drop_impossible_theory(grating)


def spectral_colour(wavelength_nm):
    """A rough linear RGB of a wavelength, after the shape of the eye's sensitivities."""
    def bell(centre, width):
        return math.exp(-(((wavelength_nm - centre) / width) ** 2))
    return bell(610, 60), bell(545, 50), bell(455, 35)


def viewport_colour(grating):
    """The metal's colour, mixed with that of the order that returns at 30 degrees: 2 d sin 30 = m lambda."""
    metal = METAL_COLOURS.get(grating.get("metal"), (0.95, 0.95, 0.95))
    tint = value_at(grating, ("cover", "tint"), (1, 1, 1))
    pitch = value_at(grating, ("grating", "pitch_nm"), 1600)
    if is_lattice(grating):
        pitch = math.hypot(*grating["grating"]["lattice"]["a_nm"])
    order = max(1, round(pitch / 550))
    spectral = spectral_colour(pitch / order) if 380 <= pitch / order <= 780 else (1, 1, 1)
    return tuple(m * t * (1 + s) / 2 for m, t, s in zip(metal, tint, spectral))
