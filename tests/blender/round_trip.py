"""Inside Blender: a model with gratings is exported, imported again and compared.

Argument after --: a folder. Leaves there plain.glb (no gratings), scene.glb, scene.gltf with its files, and again.glb
(exported after the import). Exits with 1 and a message if something differs.
"""

import json
import sys
from pathlib import Path

import bpy

folder = Path(sys.argv[sys.argv.index("--") + 1])


def expect(found, expected, what):
    if found != expected:
        print(f"FAILED: {what}: {found!r}, expected {expected!r}")
        sys.exit(1)


def grooves(name, size=4):
    image = bpy.data.images.new(name, size, size)
    image.colorspace_settings.name = "Non-Color"
    image.pixels[:] = [value for i in range(size * size) for value in (i / 255, 128 / 255, 0, 1)]
    return image


def pixels(image):
    return [round(255 * value) for value in image.pixels]


def add_disc(name):
    bpy.ops.mesh.primitive_plane_add()
    plane = bpy.context.object
    plane.name = name
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    plane.data.materials.append(material)
    return material


def give_preset(material, name):
    from rowland_diffraction import rowland_folder

    with bpy.context.temp_override(material=material):
        bpy.ops.rowland.preset(file=str(rowland_folder.MATERIALS / f"{name}.json"))


def export(name, **settings):
    bpy.ops.export_scene.gltf(filepath=str(folder / name), **settings)


def gratings():
    return {material.name: material.rowland.object() for material in bpy.data.materials if material.rowland.text}


class DrawnLayout:
    """Reads what a panel shows, as Blender does in each redraw."""

    def __init__(self):
        self.shown = []

    def prop(self, fields, name, text=None):
        getattr(fields, name)
        self.shown.append(name)

    def label(self, text):
        self.shown.append(text)

    def template_ID(self, _fields, name, **_more):
        self.shown.append(name)

    def row(self):
        return self

    def operator(self, *_more, **_names):
        return self

    operator_menu_enum = operator


def draw_panel(material):
    from rowland_diffraction import panel

    drawn = DrawnLayout()
    with bpy.context.temp_override(material=material):
        panel.ROWLAND_PT_grating.draw(type("Panel", (), {"layout": drawn}), bpy.context)
    return drawn.shown


def check_lattice(material):
    give_preset(material, "phone_screen")
    preset = material.rowland.object()
    shown = draw_panel(material)
    expect([name for name in ("Lattice of 50000 x 50000 nm", "width_nm", "orders") if name not in shown], [], "shown")
    expect([name for name in ("pitch_nm", "profile", "lobe", "groove_image") if name in shown], [], "not of a lattice")
    expect(material.rowland.object(), preset, "a lattice that was only drawn")
    material.rowland.width_nm = 20000
    material.rowland.orders = "8"
    expect(material.rowland.object()["grating"]["profile"]["width_nm"], 20000, "the opening's width")
    expect(material.rowland.object()["grating"]["orders"], 8, "a lattice's orders")


def check_profiles(material):
    """Whatever profiles the schema has."""
    from rowland_diffraction import grating

    preset = material.rowland.object()
    for kind, members in grating.PROFILES.items():
        material.rowland.profile = kind
        expect(list(material.rowland.object()["grating"]["profile"]), ["type", *members], f"members of {kind}")
        expect([name for name in members if name not in draw_panel(material)], [], f"fields of {kind}")
        given = material.rowland.object()["grating"]["profile"]
        expect(min((v for v in given.values() if not isinstance(v, str)), default=1) > 0, True, f"numbers of {kind}")
        expect(given.get("width_nm", 0) < 740, True, "a slit within the pitch of a DVD")
    material.rowland.replace(preset)


def check_orders(fields):
    fields.pitch_nm = 5000
    expect(fields.object()["grating"]["orders"], "all", "orders that nobody chose")
    fields.orders = "1, -1"
    fields.pitch_nm = 900
    expect(fields.object()["grating"]["orders"], [-1, 1], "orders that were typed")
    fields.orders = "one"
    expect(fields.orders, "-1 1", "text that is no order")


def check_show():
    """What the demo gets: the camera, and meshes as their modifiers leave them."""
    from rowland_diffraction import panel, rowland_folder

    bpy.ops.object.camera_add(location=(0, 0, 5))
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = 2
    started = []
    panel.subprocess.Popen = started.append
    rowland_folder.find_program = lambda name: name
    bpy.ops.rowland.show(program="demo")
    expect(started[0][:2], ["rowland-demo", "--scene"], "the program")
    data = Path(started[0][2]).read_bytes()
    gltf = json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])
    expect(len(gltf.get("cameras", [])), 1, "cameras")
    most = max(gltf["accessors"][mesh["primitives"][0]["attributes"]["POSITION"]]["count"] for mesh in gltf["meshes"])
    expect(most > 4, True, "a modifier's vertices")


def add_box(name):
    bpy.ops.object.empty_add(type="CUBE", radius=0.5, location=(1, 2, 3))
    box = bpy.context.object
    box.name = name
    box.scale = (6, 4, 3)
    box.rotation_euler = (0, 0, 0.5)
    box.rowland_probe.file = f"rooms/{name}.probe"
    box.rowland_probe.fade_m = 0.25


def box_of(name):
    """Lengths along the object's axes, centre, probe and fade."""
    box = bpy.data.objects[name]
    lengths = [round(2 * box.empty_display_size * factor, 4) for factor in box.scale]
    return lengths, [round(v, 4) for v in box.location], box.rowland_probe.file, round(box.rowland_probe.fade_m, 6)


def check_box_of_other_lengths():
    from rowland_diffraction import light_probe

    bpy.ops.object.empty_add()
    light_probe.replace(bpy.context.object, {"size_m": [6, 3, 4], "probe": "a.probe"})
    expect(box_of(bpy.context.object.name)[0], [6, 4, 3], "glTF's Y is Blender's Z")
    expect(bpy.context.object.rowland_probe.fade_m, 1, "the default fade")


def edit_by_panel(fields):
    """What the panel's fields do to the object."""
    fields.lines_per_mm = 1000
    expect(fields.object()["grating"]["pitch_nm"], 1000, "lines per mm")
    fields.pitch_nm = 833.333
    expect(fields.object()["grating"]["pitch_nm"], 833.333, "pitch, not rounded to a float")
    fields.pitch_nm = -5
    expect(fields.object()["grating"]["pitch_nm"], 1, "the schema's limit")
    fields.pitch_nm = 1000
    fields.profile = "sinusoidal"
    fields.depth_nm = 150
    expect(fields.object()["grating"]["profile"], {"type": "sinusoidal", "depth_nm": 150}, "profile")
    fields.lobe = "pit_sequence"
    fields.sequence_sigma = 0.03
    fields.sequence_coherent = 2
    expect(fields.object()["grating"]["groove_lobe"],
           {"pit_sequence": {"spacings_nm": list(range(900, 3301, 300)), "sigma": 0.03, "coherent": 1}}, "lobe of pits")
    fields.lobe = "sigma"
    fields.sigma = 0.05
    expect(fields.object()["grating"]["groove_lobe"], {"sigma": 0.05}, "lobe")
    expect(fields.object()["quality"], {"representation": "streak"}, "a representation that draws this lobe")
    fields.transmits = True
    fields.transmission_ior = 1.46
    fields.transmission_reflectance = 0.25
    expect(fields.object()["transmission"], {"ior": 1.46, "reflectance": 0.25}, "transmission")
    expect("metal" in fields.object(), False, "a sheet has no metal")
    fields.transmits = False
    expect("transmission" in fields.object(), False, "no transmission")
    fields.metal = "perfect"
    expect("metal" in fields.object(), False, "no metal")
    fields.metal = "Au"
    fields.covered = False
    fields.covered = True
    fields.cover_ior = 1.49
    fields.cover_tint = (1, 0.5, 0.25)
    expect(fields.object()["cover"], {"ior": 1.49, "tint": [1, 0.5, 0.25]}, "cover")
    fields.groove_rotation = 0.5
    expect(fields.object()["grooveRotation"], 0.5, "rotation")
    expect(tuple(round(v, 2) for v in fields.id_data.diffuse_color[:3]) != (0.8, 0.8, 0.8), True, "viewport colour")


def check_foil():
    """Recipes pass the panel unchanged; a card made twice is one card, with a groove image of 16 bits."""
    from rowland_diffraction import rowland_folder

    recipes = rowland_folder.FOLDER / "content" / "foil"
    fields = bpy.context.scene.rowland_foil
    for file in sorted(recipes.glob("*.json")):
        bpy.ops.rowland.foil_open(filepath=str(file))
        expect(fields.recipe(recipes), json.loads(file.read_text()), f"the recipe of {file.name}")
    bpy.ops.rowland.foil_open(filepath=str(recipes / "crystal.json"))
    fields.texture_px = 512
    fields.foil_scale = 1.5
    bpy.ops.rowland.foil_save(filepath=str(folder / "card.json"))
    saved = json.loads((folder / "card.json").read_text())
    expect((saved["foil"]["scale"], saved["texture_px"]), (1.5, 512), "numbers of the panel")
    bpy.ops.rowland.foil_open(filepath=str(folder / "card.json"))
    bpy.ops.rowland.foil_make()
    bpy.data.objects["crystal"].location.z = 2
    material_count, image_count = len(bpy.data.materials), len(bpy.data.images)
    bpy.ops.rowland.foil_make()
    expect([o.name for o in bpy.data.objects if "crystal" in o.name], ["crystal"], "cards of one artwork")
    counts = len(bpy.data.materials), len(bpy.data.images)
    expect(counts, (material_count, image_count), "datablocks of a card made again")
    card = bpy.data.objects["crystal"]
    expect(card.location.z, 2, "the card's position")
    front = next(m for m in card.data.materials if m.rowland.text)
    image = front.rowland.groove_image
    depth = int.from_bytes(image.packed_file.data[24:25], "big")
    expect((depth, image.is_float, image.colorspace_settings.name), (16, True, "Non-Color"), "the groove image")
    fields.artwork = str(folder / "missing.png")
    try:
        bpy.ops.rowland.foil_make()
    except RuntimeError as error:
        expect("missing.png" in str(error), True, "rowland-cook's message")
    else:
        expect("a card", "an error", "a card without artwork")
    return front


def check_viewport(material):
    """Few enough closures, and an export that does not change."""
    from rowland_diffraction import viewport

    def exported():
        export("viewport.gltf", export_format="GLTF_SEPARATE")
        return json.loads((folder / "viewport.gltf").read_text())["materials"]

    before, groups = exported(), len(bpy.data.node_groups)
    material.rowland.viewport_colours = True
    node = material.node_tree.nodes[viewport.GROUP]
    expect(node.node_tree.users, 1, "materials of a group")
    expect(0 < sum(one.type == "GROUP" for one in node.node_tree.nodes) <= viewport.MOST_CLOSURES, True, "closures")
    expect(exported(), before, "the export with viewport colours")
    material.rowland.pitch_nm = 1234
    expect(len(bpy.data.node_groups), groups + 2, "groups of a grating that was changed")
    material.rowland.pitch_nm = 1000
    material.rowland.viewport_colours = False
    expect((exported(), viewport.GROUP in material.node_tree.nodes), (before, False), "the export after them")


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="rowland_diffraction")

for name in ("Plain", "DVD", "Vinyl", "Foil"):
    add_disc(name)
export("plain.glb")
give_preset(bpy.data.materials["DVD"], "dvd")
give_preset(bpy.data.materials["Vinyl"], "vinyl")
give_preset(bpy.data.materials["Foil"], "holographic_foil")
edit_by_panel(bpy.data.materials["Foil"].rowland)
foil = bpy.data.materials["Foil"].rowland
foil.groove_image = grooves("grooves")
foil.sampler = json.dumps({"magFilter": 9728, "wrapS": 33071})
value = foil.object()
value["grooveTexture"] = {"sparkle": True, "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}}
foil.replace(value)
wear = bpy.data.materials["Foil"].rowland_wear
wear.dust = 0.3
wear.size_m = 0.085
wear.seed = 2147483647
wear.mask = grooves("worn", 2)
expect(bpy.data.materials["DVD"].rowland_wear.object(), {}, "a new disc's wear")
worn = wear.object()
before = gratings()
expect(sorted(before), ["DVD", "Foil", "Vinyl"], "materials with gratings")
add_box("Hall")
bpy.ops.object.empty_add()
box = box_of("Hall")
expect(box, ([6, 4, 3], [1, 2, 3], "rooms/Hall.probe", 0.25), "a new box")
export("scene.glb")
export("scene.gltf", export_format="GLTF_SEPARATE")

for name in ("scene.glb", "scene.gltf"):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="rowland_diffraction")
    bpy.ops.import_scene.gltf(filepath=str(folder / name))
    expect(gratings(), before, f"the objects of {name}")
    expect(box_of("Hall"), box, f"the box of {name}")
    expect([o.name for o in bpy.data.objects if o.rowland_probe.file], ["Hall"], f"the boxes of {name}")
    fields = bpy.data.materials["Foil"].rowland
    expect(pixels(fields.groove_image), [v for i in range(16) for v in (i, 128, 0, 255)], f"the image of {name}")
    expect(json.loads(fields.sampler), {"magFilter": 9728, "wrapS": 33071}, f"the sampler of {name}")
    expect(bpy.data.materials["Plain"].rowland.text, "", "a material without a grating")
    expect(bpy.data.materials["Foil"].rowland_wear.object(), worn, f"the wear of {name}")
    expect(pixels(bpy.data.materials["Foil"].rowland_wear.mask)[:2], [0, 128], f"the wear's mask in {name}")
    expect(bpy.data.materials["Plain"].rowland_wear.object(), {}, "a material without wear")
    with bpy.context.temp_override(material=bpy.data.materials["Foil"]):
        bpy.ops.rowland.remove()
    expect("Foil" in gratings(), False, "a grating that was removed")
export("again.glb")

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="rowland_diffraction")
check_lattice(add_disc("Screen"))
disc = add_disc("Disc")
give_preset(disc, "dvd")
expect("pitch_nm" in draw_panel(disc), True, "a grating of grooves is shown")
check_profiles(disc)
check_orders(disc.rowland)
export("screen.glb")
check_box_of_other_lengths()
check_viewport(check_foil())
check_show()
