"""The panel of the material tab and its operators."""

import subprocess
import tempfile
from pathlib import Path

import bpy

from . import grating, properties, rowland_folder, viewport

# The fields under each lobe.
LOBE_FIELDS = {
    "flat": (), "sigma": ("sigma",), "pits": ("length_nm", "coherent"),
    "pit_sequence": ("sequence_coherent", "sequence_sigma"),
}
# In place of the titles of grooves' members.
LATTICE_TITLES = {"width_nm": "Opening's width (nm)", "depth_nm": "Depth (nm)"}


def has_grating(context):
    return context.material is not None and context.material.rowland.text != ""


class ROWLAND_OT_preset(bpy.types.Operator):
    """Set this grating on the material"""

    bl_idname = "rowland.preset"
    bl_label = "Grating"
    bl_options = {"REGISTER", "UNDO"}

    file: bpy.props.EnumProperty(name="Preset", items=properties.preset_items)

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def execute(self, context):
        context.material.rowland.orders_chosen = False
        context.material.rowland.replace(grating.from_preset(self.file))
        return {"FINISHED"}


class ROWLAND_OT_remove(bpy.types.Operator):
    """Remove the grating"""

    bl_idname = "rowland.remove"
    bl_label = "Remove grating"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return has_grating(context)

    def execute(self, context):
        context.material.rowland.text = ""
        context.material.rowland.viewport_colours = False
        context.material.rowland.groove_image = None
        return {"FINISHED"}


class ROWLAND_OT_show(bpy.types.Operator):
    """Export the scene, its modifiers applied, to a temporary GLB and open it in Rowland, seen by its camera"""

    bl_idname = "rowland.show"
    bl_label = "Show"

    program: bpy.props.EnumProperty(items=[("demo", "Demo", ""), ("inspector", "Inspector", "")])

    def execute(self, _context):
        program = rowland_folder.find_program(f"rowland-{self.program}")
        if program is None:
            self.report({"ERROR"}, f"rowland-{self.program} is not built: run ./rowland in {rowland_folder.FOLDER}")
            return {"CANCELLED"}
        file = Path(tempfile.mkdtemp(prefix="rowland-")) / "scene.glb"
        bpy.ops.export_scene.gltf(filepath=str(file), export_format="GLB", export_tangents=True, export_apply=True,
                                  export_cameras=True)
        subprocess.Popen([program, *(["--scene"] if self.program == "demo" else []), str(file)])
        return {"FINISHED"}


class ROWLAND_PT_grating(bpy.types.Panel):
    bl_label = "Diffraction grating"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        fields = context.material.rowland
        row = layout.row()
        row.operator_menu_enum(ROWLAND_OT_preset.bl_idname, "file", text="Preset")
        row.operator(ROWLAND_OT_remove.bl_idname, text="", icon="X")
        if not fields.text:
            return
        value = fields.object()
        table = False
        titles = {}
        if grating.is_lattice(value):
            titles = LATTICE_TITLES
            layout.label(text=grating.cell_text(value))
            names = [*grating.lattice_fields(value), "orders", "groove_rotation"]
        else:
            names = ["pitch_nm", "lines_per_mm", "orders", "profile", *grating.PROFILES[fields.profile]]
            names += ["lobe", *LOBE_FIELDS[fields.lobe], "groove_rotation"]
            table = fields.profile == "table"
        names += ["transmits"] + (["transmission_ior", "transmission_reflectance"] if fields.transmits else [])
        names += [] if table or fields.transmits else ["metal"]
        names += [] if fields.transmits else ["covered"] + (["cover_ior"] if fields.covered else [])
        names += ["cover_tint"] if fields.covered and not table else []
        for name in names:
            layout.prop(fields, name, text=titles.get(name))
        if not grating.is_lattice(value):
            layout.template_ID(fields, "groove_image", new="image.new", open="image.open", text="Groove image")
        if viewport.drawable(value):
            layout.prop(fields, "viewport_colours")
        row = layout.row()
        for program in ("demo", "inspector"):
            row.operator(ROWLAND_OT_show.bl_idname, text=f"Open in the {program}").program = program


CLASSES = (ROWLAND_OT_preset, ROWLAND_OT_remove, ROWLAND_OT_show, ROWLAND_PT_grating)
