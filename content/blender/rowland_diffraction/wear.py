"""Marks of use on a material: the glTF extension ROWLAND_materials_wear."""

import bpy

EXTENSION = "ROWLAND_materials_wear"
MARKS = ("scratches", "fingerprints", "dust")
NUMBERS = (*MARKS, "size_m", "seed", "texCoord")


class RowlandWear(bpy.types.PropertyGroup):
    scratches: bpy.props.FloatProperty(
        name="Scratches", min=0, max=1, subtype="FACTOR", description="1: 170 000 in a square metre")
    fingerprints: bpy.props.FloatProperty(
        name="Fingerprints", min=0, max=1, subtype="FACTOR", description="1: 400 in a square metre")
    dust: bpy.props.FloatProperty(
        name="Dust", min=0, max=1, subtype="FACTOR", description="1: 3 million specks in a square metre")
    size_m: bpy.props.FloatProperty(
        name="Size (m)", min=0.005, max=2, default=0.12, precision=3,
        description="Width of the surface over which the UV map goes from 0 to 1")
    seed: bpy.props.IntProperty(name="Seed", min=0, default=1, description="Another one draws other marks")
    texCoord: bpy.props.IntProperty(name="UV map", min=0, max=1, description="The first (0) or the second (1)")
    mask: bpy.props.PointerProperty(
        name="Mask", type=bpy.types.Image, description="Its red multiplies the marks, in the first UV map")

    def object(self):
        """The extension's object without its mask; empty: no wear."""
        if not any(getattr(self, mark) > 0 for mark in MARKS):
            return {}
        rounded = {name: float(f"{getattr(self, name):.7g}") for name in (*MARKS, "size_m")}
        return {**rounded, "seed": self.seed, "texCoord": self.texCoord}

    def replace(self, value):
        for name in NUMBERS:
            if name in value:
                setattr(self, name, value[name])
            else:
                self.property_unset(name)


class ROWLAND_PT_wear(bpy.types.Panel):
    bl_label = "Wear"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        fields = context.material.rowland_wear
        for name in NUMBERS:
            self.layout.prop(fields, name)
        self.layout.template_ID(fields, "mask", new="image.new", open="image.open", text="Mask")
