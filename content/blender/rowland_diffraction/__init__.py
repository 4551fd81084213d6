"""Diffraction gratings on Blender's materials, for Rowland (glTF extension ROWLAND_materials_diffraction)."""

import bpy

from .gltf import glTF2ExportUserExtension, glTF2ImportUserExtension  # noqa: F401: the glTF add-on looks for them here
from .panel import CLASSES
from .properties import RowlandGrating

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
    bpy.types.Material.rowland = bpy.props.PointerProperty(type=RowlandGrating)
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
    del bpy.types.Material.rowland
    bpy.utils.unregister_class(RowlandGrating)
