"""Foil cards: the panel of a recipe, whose fields are those of the schema of rowland-cook, and the card made of it."""

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from . import rowland_folder
from .properties import rounded

NAMES = {"deg": "(degrees)", "mm": "(mm)", "um": "(µm)", "px": "(texels)"}
CARD = "rowland_foil"  # the custom property of a card's object


class Field(NamedTuple):
    key: tuple  # path in the recipe
    schema: dict
    kind: str = ""  # the type of foil that it belongs to


def read_fields(schema, path=()):
    """The recipe's fields by the name of their property. Each type has properties and defaults of its own."""
    found = {}
    for name, member in schema["properties"].items():
        if name == "foil":
            types = {one["properties"]["type"]["const"]: one["properties"] for one in member["oneOf"]}
            found["foil_type"] = Field(("foil", "type"), {"enum": list(types)})
            shared = set.intersection(*map(set, types.values()))
            for kind, numbers in types.items():
                for key, number in numbers.items():
                    if key in shared - {"type"}:
                        found[f"foil_{key}"] = Field(("foil", key), number)
                    elif key != "type":
                        found[f"{kind}_{key}"] = Field(("foil", key), number, kind)
        elif member.get("type") == "object":
            found |= read_fields(member, (*path, name))
        else:
            found["_".join((*path, name))] = Field((*path, name), member)
    return found


def titled(key):
    words = key.split("_")
    return " ".join([words[0].capitalize(), *words[1:-1], *(NAMES.get(word, word) for word in words[1:][-1:])])


def property_of(field):
    """A field that was not set is left out of the recipe; rowland-cook then takes its default."""
    schema, name = field.schema, titled(field.key[-1])
    if "enum" in schema:
        values = schema["enum"] if field.key[-1] == "type" else ["", *schema["enum"]]
        items = [(value or "default", titled(value or "default"), "", i) for i, value in enumerate(values)]
        return bpy.props.EnumProperty(name=name, items=items, default="cracked_ice" if "cracked_ice" in values else 0)
    if schema["type"] == "boolean":
        return bpy.props.BoolProperty(name=name, default=schema.get("default", True))
    if schema["type"] == "string":
        return bpy.props.StringProperty(name=name, subtype="FILE_PATH", description="PNG or JPEG")
    item = schema.get("items", schema)
    known = {"default": schema.get("default", 0), "min": item["minimum"], "max": min(item["maximum"], 2**31 - 1)}
    if "default" not in schema:
        known |= {"min": min(0, known["min"]), "description": "0: as the type of foil needs"}
    if schema["type"] == "array":
        known["default"] = schema.get("default", [1.0 if "tint" in field.key else 0.0] * schema["minItems"])
        subtype = "COLOR" if "tint" in field.key else "NONE"
        return bpy.props.FloatVectorProperty(name=name, size=schema["minItems"], subtype=subtype, **known)
    if schema["type"] == "integer":
        return bpy.props.IntProperty(name=name, **known)
    return bpy.props.FloatProperty(name=name, precision=3, **known)


FIELDS = read_fields(rowland_folder.load_schema("foil"))


class RowlandFoil(bpy.types.PropertyGroup):
    def value(self, name):
        """The value in a recipe; None: it is left out."""
        value, rna = getattr(self, name), self.bl_rna.properties[name]
        listed = getattr(rna, "is_array", False)
        initial = tuple(value) == tuple(rna.default_array) if listed else value == rna.default
        if name != "foil_type" and (not self.is_property_set(name) or initial and "default" not in FIELDS[name].schema):
            return None
        if rna.type == "FLOAT":
            return [rounded(v) for v in value] if listed else rounded(value)
        return value

    def recipe(self, folder):
        """The recipe for a file in the folder."""
        recipe = {}
        for name, field in FIELDS.items():
            value = self.value(name)
            if value is None or field.kind not in ("", self.foil_type):
                continue
            if field.schema.get("type") == "string":
                value = os.path.relpath(bpy.path.abspath(value), folder).replace(os.sep, "/")
            owner = recipe
            for key in field.key[:-1]:
                owner = owner.setdefault(key, {})
            owner[field.key[-1]] = value
        return recipe

    def replace(self, recipe, folder):
        """Throws TypeError, ValueError or AttributeError for a recipe that rowland-cook would refuse as well."""
        for name in FIELDS:
            self.property_unset(name)
        self.foil_type = recipe.get("foil", {}).get("type", self.foil_type)
        for name, field in FIELDS.items():
            value = recipe
            for key in field.key:
                value = value.get(key) if value is not None else None
            if value is not None and field.kind in ("", self.foil_type):
                is_file = field.schema.get("type") == "string"
                setattr(self, name, os.path.normpath(os.path.join(folder, value)) if is_file else value)


RowlandFoil.__annotations__ = {name: property_of(field) for name, field in FIELDS.items()}


class ROWLAND_OT_foil_open(bpy.types.Operator, ImportHelper):
    """Fill the panel from a foil recipe"""

    bl_idname = "rowland.foil_open"
    bl_label = "Open recipe..."
    bl_options = {"REGISTER", "UNDO"}
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        try:
            recipe = json.loads(Path(self.filepath).read_text(encoding="utf-8"))
            context.scene.rowland_foil.replace(recipe, os.path.dirname(os.path.abspath(self.filepath)))
        except (OSError, ValueError, TypeError, AttributeError) as error:
            self.report({"ERROR"}, f"{self.filepath} is no foil recipe: {error}")
            return {"CANCELLED"}
        return {"FINISHED"}


class ROWLAND_OT_foil_save(bpy.types.Operator, ExportHelper):
    """Write the panel as a foil recipe"""

    bl_idname = "rowland.foil_save"
    bl_label = "Save recipe..."
    filename_ext = ".json"

    def execute(self, context):
        recipe = context.scene.rowland_foil.recipe(os.path.dirname(os.path.abspath(self.filepath)))
        try:
            Path(self.filepath).write_text(json.dumps(recipe, indent=2) + "\n", encoding="utf-8")
        except OSError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def remove_unused(old_mesh):
    """Removes an earlier card's mesh, and its materials and images that nothing else uses."""
    materials = list(old_mesh.materials)
    bpy.data.meshes.remove(old_mesh)
    for material in materials:
        if material.users:
            continue
        images = {node.image for node in material.node_tree.nodes if node.type == "TEX_IMAGE" and node.image}
        images |= {material.rowland.groove_image} - {None}
        material.rowland.viewport_colours = False  # removes its node group
        bpy.data.materials.remove(material)
        for image in images:
            if not image.users:
                bpy.data.images.remove(image)


class ROWLAND_OT_foil_make(bpy.types.Operator):
    """Make a card of this recipe. It replaces an earlier card of the same artwork, and keeps its position"""

    bl_idname = "rowland.foil_make"
    bl_label = "Make card"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        program = rowland_folder.find_program("rowland-cook")
        fields = context.scene.rowland_foil
        with tempfile.TemporaryDirectory(prefix="rowland-") as folder:
            recipe, card = Path(folder) / "recipe.json", Path(folder) / "card.glb"
            recipe.write_text(json.dumps(fields.recipe(folder)), encoding="utf-8")
            made = subprocess.run([program, "foil", str(recipe), "-o", str(card)], capture_output=True, text=True)
            if made.returncode:
                self.report({"ERROR"}, made.stderr.strip())
                return {"CANCELLED"}
            before = set(bpy.data.objects)
            bpy.ops.import_scene.gltf(filepath=str(card))
        new = next(one for one in bpy.data.objects if one not in before)
        name = Path(fields.artwork).stem
        old = next((one for one in context.scene.objects if one.get(CARD) == name), None)
        if old:
            old_mesh, old.data = old.data, new.data
            bpy.data.objects.remove(new)
            new = old
            if old_mesh.users == 0:
                remove_unused(old_mesh)
        new[CARD] = new.name = new.data.name = name
        return {"FINISHED"}


class ROWLAND_PT_foil(bpy.types.Panel):
    bl_label = "Foil card"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Rowland"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        fields = context.scene.rowland_foil
        row = layout.row()
        row.operator(ROWLAND_OT_foil_open.bl_idname)
        row.operator(ROWLAND_OT_foil_save.bl_idname)
        for name, field in FIELDS.items():
            if field.kind in ("", fields.foil_type):
                layout.prop(fields, name)
        layout.operator(ROWLAND_OT_foil_make.bl_idname, icon="FILE_REFRESH")


CLASSES = (ROWLAND_OT_foil_open, ROWLAND_OT_foil_save, ROWLAND_OT_foil_make, ROWLAND_PT_foil)
