"""Writes and reads gratings, wear and boxes of probes with Blender's own glTF exporter and importer, which call these
classes."""

import importlib
import json
import os
import tempfile
import urllib.parse

import bpy
import numpy

from . import grating, light_probe, wear

# Without this Debian 12's Blender imports no mesh: its glTF importer uses numpy.bool, which its NumPy has removed.
if "bool" not in numpy.__dict__:
    numpy.bool = bool

SAMPLER_MEMBERS = {"mag_filter": "magFilter", "min_filter": "minFilter", "wrap_s": "wrapS", "wrap_t": "wrapT"}


def image_bytes(image):
    """The image as a PNG or JPEG file: the loaded one, or a new PNG."""
    if image.is_dirty:
        return png_of(image)
    data = image.packed_file.data if image.packed_file else b""
    path = bpy.path.abspath(image.filepath, library=image.library)
    if not data and image.source == "FILE" and os.path.isfile(path):
        with open(path, "rb") as file:
            data = file.read()
    return data if data.startswith((b"\x89PNG", b"\xff\xd8")) else png_of(image)


def png_of(image):
    """The image as a new PNG file. A copy is saved, so that the image's state and path do not change."""
    pixels = numpy.empty(len(image.pixels), numpy.float32)
    image.pixels.foreach_get(pixels)
    copy = bpy.data.images.new(image.name, *image.size, alpha=True)
    copy.colorspace_settings.name = image.colorspace_settings.name
    copy.pixels.foreach_set(pixels)
    with tempfile.TemporaryDirectory() as folder:
        copy.filepath_raw = os.path.join(folder, "image.png")
        copy.file_format = "PNG"
        copy.save()
        with open(copy.filepath_raw, "rb") as file:
            data = file.read()
    bpy.data.images.remove(copy)
    return data


def exporter_module(name):
    """A module of Blender's exporter; in Blender 3 their names began with gltf2_io_."""
    try:
        return importlib.import_module(f"io_scene_gltf2.io.exp.{name}")
    except ModuleNotFoundError:
        return importlib.import_module(f"io_scene_gltf2.io.exp.gltf2_io_{name}")


class glTF2ExportUserExtension:
    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

        self.Extension = Extension
        self.textures = {}

    def texture(self, image, sampler_text, export_settings):
        """The exporter's texture of an image; materials with the same image and sampler share one."""
        from io_scene_gltf2.io.com import gltf2_io

        BinaryData = exporter_module("binary_data").BinaryData
        ImageData = exporter_module("image_data").ImageData
        key = (image.name, sampler_text)
        if key not in self.textures:
            data = image_bytes(image)
            media_type = "image/png" if data.startswith(b"\x89PNG") else "image/jpeg"
            separate = export_settings["gltf_format"] == "GLTF_SEPARATE"
            source = gltf2_io.Image(
                buffer_view=None if separate else BinaryData(data), extensions=None, extras=None, mime_type=media_type,
                name=image.name, uri=ImageData(data, media_type, image.name) if separate else None)
            sampler = json.loads(sampler_text) if sampler_text else {}
            members = {name: sampler.get(member) for name, member in SAMPLER_MEMBERS.items()}
            self.textures[key] = gltf2_io.Texture(
                extensions=None, extras=None, name=image.name, source=source,
                sampler=gltf2_io.Sampler(extensions=None, extras=None, name=None, **members) if sampler else None)
        return self.textures[key]

    def gather_material_hook(self, gltf2_material, blender_material, export_settings):
        if blender_material.rowland.text:
            self.add(grating.EXTENSION, self.grating(blender_material.rowland, export_settings), gltf2_material)
        fields = blender_material.rowland_wear
        if value := fields.object():
            if fields.mask:
                value["maskTexture"] = {"index": self.texture(fields.mask, "", export_settings)}
            self.add(wear.EXTENSION, value, gltf2_material)

    def gather_node_hook(self, gltf2_node, blender_object, export_settings):
        if value := blender_object and light_probe.extension_of(blender_object):
            self.add(light_probe.EXTENSION, value, gltf2_node)

    def add(self, name, value, gltf2_thing):
        if gltf2_thing.extensions is None:
            gltf2_thing.extensions = {}
        gltf2_thing.extensions[name] = self.Extension(name=name, extension=value, required=False)

    def grating(self, fields, export_settings):
        value = fields.object()
        folder = os.path.dirname(os.path.abspath(export_settings["gltf_filepath"]))
        grating.move_files(value, grating.relative_to(folder))
        texture = value.pop("grooveTexture", {})
        if fields.groove_image:
            transform = texture.get("extensions", {})
            if transform:
                texture["extensions"] = {
                    name: self.Extension(name=name, extension=member, required=False)
                    for name, member in transform.items()
                }
            index = self.texture(fields.groove_image, fields.sampler, export_settings)
            value["grooveTexture"] = {**texture, "index": index}
        return value


def imported_image(gltf, index):
    """The Blender image of a glTF texture."""
    from io_scene_gltf2.io.imp.gltf2_io_binary import BinaryData

    source = gltf.data.textures[index].source
    image = gltf.data.images[source]
    if image.blender_image_name is not None:  # already loaded for another texture
        return bpy.data.images[image.blender_image_name]
    if image.uri is not None and not image.uri.startswith("data:"):
        path = os.path.join(os.path.dirname(os.path.abspath(gltf.filename)), urllib.parse.unquote(image.uri))
        return bpy.data.images.load(path, check_existing=True)
    data = bytes(BinaryData.get_image_data(gltf, source))
    packed = bpy.data.images.new(image.name or f"Image_{source}", 8, 8)  # the size becomes that of the data
    packed.pack(data=data, data_len=len(data))
    packed.source = "FILE"
    image.blender_image_name = packed.name
    return packed


def sampler_text(gltf, index):
    texture = gltf.data.textures[index]
    if texture.sampler is None:
        return ""
    sampler = gltf.data.samplers[texture.sampler]
    members = {member: getattr(sampler, name) for name, member in SAMPLER_MEMBERS.items()}
    return json.dumps({member: value for member, value in members.items() if value is not None})


class glTF2ImportUserExtension:
    def __init__(self):
        from io_scene_gltf2.io.com.gltf2_io_extensions import Extension

        names = (grating.EXTENSION, wear.EXTENSION, light_probe.EXTENSION)
        self.extensions = [Extension(name=name, extension={}, required=False) for name in names]

    def gather_import_material_after_hook(self, gltf_material, _vertex_color, blender_material, gltf):
        extensions = json.loads(json.dumps(gltf_material.extensions or {}))
        if value := extensions.get(wear.EXTENSION):
            blender_material.rowland_wear.replace(value)
            if "maskTexture" in value:
                blender_material.rowland_wear.mask = imported_image(gltf, value["maskTexture"]["index"])
        value = extensions.get(grating.EXTENSION)
        if value is None:
            return
        folder = os.path.dirname(os.path.abspath(gltf.filename))
        grating.move_files(value, lambda name: os.path.normpath(os.path.join(folder, name)))
        fields = blender_material.rowland
        fields.orders_chosen = grating.value_at(value, ("grating", "orders")) is not None
        if "grooveTexture" in value:
            index = value["grooveTexture"].pop("index")
            fields.groove_image = imported_image(gltf, index)
            fields.sampler = sampler_text(gltf, index)
        fields.replace(value)

    def gather_import_node_after_hook(self, _vnode, gltf_node, blender_object, _gltf):
        if value := ((gltf_node and gltf_node.extensions) or {}).get(light_probe.EXTENSION):
            light_probe.replace(blender_object, value)
