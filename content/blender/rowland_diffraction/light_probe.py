"""Boxes with a probe each: the glTF extension ROWLAND_light_probe of nodes, here an Empty shown as a cube."""

import bpy
from mathutils import Vector

EXTENSION = "ROWLAND_light_probe"


class RowlandLightProbe(bpy.types.PropertyGroup):
    file: bpy.props.StringProperty(
        name="Probe", description="The cooked probe, from the glTF's folder: rooms/hall.probe. Empty: no box")
    fade_m: bpy.props.FloatProperty(
        name="Fade (m)", min=0, soft_max=5, default=1,
        description="How far beyond the box its light gives way to other light")


def extension_of(blender_object):
    """The extension's object; None if the object is not a box with a probe."""
    fields = blender_object.rowland_probe
    if not fields.file or blender_object.type != "EMPTY":
        return None
    side = 2 * blender_object.empty_display_size  # its scale is the node's
    return {"size_m": [side] * 3, "fade_m": float(f"{fields.fade_m:.7g}"), "probe": fields.file}


def replace(blender_object, value):
    """Sets the box of an Empty. Its cube has one size, so the scale holds the lengths. glTF's Y is Blender's Z."""
    x, y, z = value["size_m"]
    blender_object.empty_display_type = "CUBE"
    blender_object.empty_display_size = 0.5
    blender_object.scale = Vector(blender_object.scale) * Vector((x, z, y))
    blender_object.rowland_probe.file = value["probe"]
    blender_object.rowland_probe.fade_m = value.get("fade_m", 1)


class ROWLAND_PT_light_probe(bpy.types.Panel):
    bl_label = "Light of a box"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "EMPTY"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        fields = context.object.rowland_probe
        self.layout.prop(fields, "file")
        self.layout.prop(fields, "fade_m")
        if fields.file and context.object.empty_display_type != "CUBE":
            self.layout.label(text="The box is the Empty's cube: Object Data > Display As", icon="INFO")
