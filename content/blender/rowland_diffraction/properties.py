"""The grating of a Blender material: its JSON object as text, and a property for each field of the panel that reads and
writes this text. Members that the panel does not show are kept."""

import json

import bpy

from . import grating, rowland_folder, viewport

_preset_items = []  # Blender keeps no reference to the strings of items


def preset_items(_self, _context):
    _preset_items[:] = [(str(file), file.stem.replace("_", " "), "") for file in rowland_folder.preset_files()]
    return _preset_items


def rounded(value):
    """Seven digits of a number, since Blender's are 32-bit floats: 833.333 comes as 833.3330078125."""
    return float(f"{value:.7g}")


def limits(schema):
    known = {}
    if "minimum" in schema or "exclusiveMinimum" in schema:
        known["min"] = schema.get("minimum", schema.get("exclusiveMinimum", 0) + 1e-6)
    if "maximum" in schema or "exclusiveMaximum" in schema:
        known["max"] = schema.get("maximum", schema.get("exclusiveMaximum", 0) - 1e-6)
    return known


def number(path, name, schema=None, otherwise=0.0, change=None, **more):
    known = limits(schema or {})

    def set_(self, value):  # Blender does not apply min and max to values that scripts set
        value = min(max(rounded(value), known.get("min", value)), known.get("max", value))
        change(self, value) if change else self.change(grating.set_value, path, value)

    return bpy.props.FloatProperty(
        name=name, get=lambda self: grating.value_at(self.object(), path, otherwise), set=set_, **known, **more)


def choice(name, values, get, set_, labels=None):
    return bpy.props.EnumProperty(
        name=name,
        items=[(value, (labels or {}).get(value, value), "") for value in values],
        get=lambda self: values.index(get(self.object())),
        set=lambda self, index: self.change(set_, values[index]),
    )


def profile_member(name, schema):
    """A number, or the name of a file."""
    path = ("grating", "profile", name)
    if schema["type"] == "number":
        return number(path, schema["title"], schema, precision=3)
    return bpy.props.StringProperty(
        name=schema["title"], subtype="FILE_PATH", get=lambda self: grating.value_at(self.object(), path, ""),
        set=lambda self, value: self.change(grating.set_value, path, bpy.path.abspath(value)))


def update_image(self, _context):
    """Sets the image to non-colour data. Blender then reloads it, so an image with unsaved pixels is not changed."""
    image = self.groove_image
    if image and not image.is_dirty and image.colorspace_settings.name != "Non-Color":
        image.colorspace_settings.name = "Non-Color"
    viewport.update(self.id_data)


COVER = grating.MEMBERS["cover"]["properties"]
TRANSMISSION = grating.MEMBERS["transmission"]["properties"]
LOBES = [lobe["properties"] for lobe in grating.GROOVES["groove_lobe"]["oneOf"] if "properties" in lobe]
LOBE = {next(iter(lobe)): lobe for lobe in LOBES}
PITS = LOBE["pits"]["pits"]["properties"]
SEQUENCE = LOBE["pit_sequence"]["pit_sequence"]["properties"]
MEMBERS = {name: schema for members in grating.PROFILES.values() for name, schema in members.items()}


class RowlandGrating(bpy.types.PropertyGroup):
    text: bpy.props.StringProperty(name="Grating", description="The extension's object; empty: no grating")
    sampler: bpy.props.StringProperty(name="Sampler", description="The glTF sampler of the groove image; empty: repeat")
    groove_image: bpy.props.PointerProperty(
        name="Groove image", type=bpy.types.Image, update=update_image,
        description="Red: rotation of the grooves / 180 degrees; green: pitch / 2; 0: no grating")

    viewport_colours: bpy.props.BoolProperty(
        name="Viewport colours", update=lambda self, _context: viewport.update(self.id_data),
        description="Nodes between surface and output show the orders in Cycles and Eevee; they are not exported")
    orders_chosen: bpy.props.BoolProperty(name="Orders chosen", description="The orders stay when the pitch changes")

    pitch_nm: number(
        ("grating", "pitch_nm"), "Pitch (nm)", grating.GROOVES["pitch_nm"], precision=3,
        change=lambda self, value: self.change(grating.set_pitch, value, self.orders_chosen))
    lines_per_mm: bpy.props.FloatProperty(
        name="Lines per mm", min=0.1, max=1e6, precision=3,
        get=lambda self: 1e6 / grating.value_at(self.object(), ("grating", "pitch_nm"), 1600),
        set=lambda self, value: self.change(grating.set_pitch, rounded(1e6 / value), self.orders_chosen))
    orders: bpy.props.StringProperty(
        name="Orders", description='Whole numbers, or "all"; of a lattice the largest. They follow the pitch until they '
        "are typed",
        get=lambda self: grating.orders_text(self.object()), set=lambda self, value: self.choose_orders(value))
    profile: choice(
        "Profile", list(grating.PROFILES), lambda o: grating.value_at(o, ("grating", "profile", "type"), "slit"),
        grating.set_profile_kind)
    height_nm: number(("grating", "profile", "height_nm"), "Opening's height (nm)", MEMBERS["width_nm"])
    lobe: choice(
        "Lobe", list(grating.LOBES), grating.lobe_kind, grating.set_lobe_kind,
        {"flat": "flat", "sigma": "narrow (sigma)", "pits": "pits", "pit_sequence": "pit sequence"})
    sigma: number(("grating", "groove_lobe", "sigma"), "Sigma", LOBE["sigma"]["sigma"], precision=4)
    length_nm: number(("grating", "groove_lobe", "pits", "length_nm"), "Pit length (nm)", PITS["length_nm"])
    coherent: number(("grating", "groove_lobe", "pits", "coherent"), "Coherent", PITS["coherent"])
    sequence_coherent: number(
        ("grating", "groove_lobe", "pit_sequence", "coherent"), "Coherent", SEQUENCE["coherent"], 0.3)
    sequence_sigma: number(
        ("grating", "groove_lobe", "pit_sequence", "sigma"), "Width of an order (sigma)", SEQUENCE["sigma"], 0.02,
        precision=4)
    metal: choice(
        "Metal", ["perfect", *grating.METALS], lambda o: o.get("metal", "perfect"),
        lambda o, value: grating.set_metal(o, None if value == "perfect" else value))
    covered: bpy.props.BoolProperty(
        name="Cover", description="A transparent layer over the grooves",
        get=lambda self: "cover" in self.object(),
        set=lambda self, value: self.change(grating.set_value, ("cover",), {"ior": 1.5} if value else None))
    cover_ior: number(("cover", "ior"), "Index of refraction", COVER["ior"], 1.5, precision=3)
    cover_tint: bpy.props.FloatVectorProperty(
        name="Tint", subtype="COLOR", size=3, min=0, max=1,
        get=lambda self: grating.value_at(self.object(), ("cover", "tint"), (1.0, 1.0, 1.0)),
        set=lambda self, value: self.change(grating.set_value, ("cover", "tint"), [rounded(v) for v in value]))
    transmits: bpy.props.BoolProperty(
        name="Transmission", description="A thin sheet that one looks through",
        get=lambda self: "transmission" in self.object(),
        set=lambda self, value: self.change(grating.set_transmits, value))
    transmission_ior: number(
        ("transmission", "ior"), "Index of refraction", TRANSMISSION["ior"], 1.5, precision=3)
    transmission_reflectance: number(
        ("transmission", "reflectance"), "Reflectance", TRANSMISSION["reflectance"], 0, precision=3)
    groove_rotation: number(
        ("grooveRotation",), "Rotation", subtype="ANGLE",
        description="Of the grating vector, from the tangent toward the bitangent")

    def object(self):
        return json.loads(self.text) if self.text else {}

    def change(self, function, *arguments):
        """Applies function(object, *arguments) and stores the object."""
        changed = self.object()
        function(changed, *arguments)
        self.replace(changed)

    def choose_orders(self, text):
        self.orders_chosen = True
        self.change(grating.set_orders, text)

    def replace(self, new_object):
        """Sets the object and the viewport's colour. Without nodes that colour would be exported as the surface."""
        self.text = json.dumps(new_object)
        if self.id_data.use_nodes:
            self.id_data.diffuse_color = (*grating.viewport_colour(new_object), 1.0)
            self.id_data.metallic = 1.0
            self.id_data.roughness = 0.25
        viewport.update(self.id_data)


RowlandGrating.__annotations__.update({name: profile_member(name, schema) for name, schema in MEMBERS.items()})
