"""Diffraction gratings and wear on Blender's materials, foil cards, and boxes with a probe each, for Rowland (glTF
extensions ROWLAND_materials_diffraction, ROWLAND_materials_wear and ROWLAND_light_probe)."""

import bpy

from . import foil
from .gltf import glTF2ExportUserExtension, glTF2ImportUserExtension  # noqa: F401: the glTF add-on looks for them here
from .light_probe import ROWLAND_PT_light_probe, RowlandLightProbe
from .panel import CLASSES
from .properties import RowlandGrating
from .wear import ROWLAND_PT_wear, RowlandWear

bl_info = {
    "name": "Rowland diffraction",
    "description": "Gratings on materials, written to and read from glTF",
    "author": "Rowland",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Material > Diffraction grating",
    "category": "Material",
}


def register():
    bpy.utils.register_class(RowlandGrating)
    bpy.utils.register_class(RowlandWear)
    bpy.utils.register_class(RowlandLightProbe)
    bpy.utils.register_class(foil.RowlandFoil)
    bpy.types.Material.rowland = bpy.props.PointerProperty(type=RowlandGrating)
    bpy.types.Material.rowland_wear = bpy.props.PointerProperty(type=RowlandWear)
    bpy.types.Object.rowland_probe = bpy.props.PointerProperty(type=RowlandLightProbe)
    bpy.types.Scene.rowland_foil = bpy.props.PointerProperty(type=foil.RowlandFoil)
    for one in (*CLASSES, *foil.CLASSES, ROWLAND_PT_wear, ROWLAND_PT_light_probe):
        bpy.utils.register_class(one)


def unregister():
    for one in reversed((*CLASSES, *foil.CLASSES, ROWLAND_PT_wear, ROWLAND_PT_light_probe)):
        bpy.utils.unregister_class(one)
    del bpy.types.Scene.rowland_foil
    del bpy.types.Object.rowland_probe
    del bpy.types.Material.rowland_wear
    del bpy.types.Material.rowland
    bpy.utils.unregister_class(foil.RowlandFoil)
    bpy.utils.unregister_class(RowlandLightProbe)
    bpy.utils.unregister_class(RowlandWear)
    bpy.utils.unregister_class(RowlandGrating)
