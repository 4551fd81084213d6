"""Inside Blender: renders the viewport's approximation of gratings in Cycles, and prints its error against
`rowland-trade evaluate --method reference` under the same light.

Arguments after --: a folder for the pictures, and material files. Prints "NAME: relative RMS PERCENT".
"""

import csv
import subprocess
import sys
from pathlib import Path

import bpy
import numpy

SIZE = 16  # pixels of a picture's side
RGB_OF_XYZ = numpy.array([[3.2404542, -1.5371385, -0.4985314], [-0.969266, 1.8760108, 0.041556],
                          [0.0556434, -0.2040259, 1.0572252]])


def to_rowland(v):
    """Blender's world (x, y, z) in a probe's axes: x right, y up, -z the image's centre. Blender centres it on +x."""
    return numpy.stack([-v[..., 1], v[..., 2], -v[..., 0]], -1)


def write_sky(file):
    """A gradient, and lamps 9 degrees wide."""
    width, height = 128, 64
    azimuth = (numpy.arange(width) + 0.5) / width * 2 * numpy.pi
    elevation = ((numpy.arange(height) + 0.5) / height - 0.5) * numpy.pi
    azimuth, elevation = numpy.meshgrid(azimuth, elevation)
    ring = numpy.cos(elevation)
    way = numpy.stack([ring * numpy.cos(azimuth), ring * numpy.sin(azimuth), numpy.sin(elevation)], -1)
    light = 0.1 + 0.2 * numpy.clip(way[..., 2], 0, 1)
    for lamp in ((0.1, 0.9), (1.8, 0.5), (3.4, 1.1), (4.9, 0.7)):
        centre = [numpy.cos(lamp[1]) * numpy.cos(lamp[0]), numpy.cos(lamp[1]) * numpy.sin(lamp[0]), numpy.sin(lamp[1])]
        light += 20 * (way @ numpy.array(centre) > numpy.cos(0.08))
    pixels = numpy.repeat(light[..., None], 4, -1).astype(numpy.float32)
    image = bpy.data.images.new("sky", width, height, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = str(file), "HDR"
    image.save()


def make_scene(sky):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 64
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 1
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.render.image_settings.file_format = "OPEN_EXR"
    bpy.ops.mesh.primitive_plane_add(size=2)
    bpy.ops.object.camera_add(location=(0, 0, 1.4))
    scene.camera = bpy.context.object
    scene.camera.data.sensor_width = 36
    scene.camera.data.lens = 18 * 1.4  # the plane fills the picture
    world = scene.world = bpy.data.worlds.new("World")
    world.use_nodes = True
    texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(str(sky))
    world.node_tree.links.new(texture.outputs[0], world.node_tree.nodes["Background"].inputs[0])
    return bpy.data.objects["Plane"]


def render_orders(plane, material_file, picture):
    """Linear Rec.709 of the listed orders, rows from the bottom."""
    from rowland_diffraction import grating, viewport

    material = bpy.data.materials.new(Path(material_file).stem)
    material.use_nodes = True
    plane.data.materials.clear()
    plane.data.materials.append(material)
    material.rowland.replace(grating.from_preset(material_file))
    material.rowland.viewport_colours = True
    tree = material.node_tree
    tree.links.new(tree.nodes[viewport.GROUP].outputs["Orders"], tree.get_output_node("ALL").inputs["Surface"])
    bpy.context.scene.render.filepath = str(picture)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(picture))
    return numpy.array(image.pixels[:]).reshape(SIZE, SIZE, 4)[..., :3]


def reference(material_file, sky, frames):
    """The same by integration over wavelengths and the probe. Colours outside of Rec.709 are clipped."""
    from rowland_diffraction import rowland_folder

    x, y = numpy.meshgrid(*[(numpy.arange(SIZE) + 0.5) / SIZE * 2 - 1] * 2)
    view = numpy.stack([-x, -y, numpy.full_like(x, 1.4)], -1)
    view /= numpy.linalg.norm(view, axis=-1, keepdims=True)
    normal, across = (to_rowland(numpy.broadcast_to(axis, view.shape)) for axis in ((0, 0, 1), (1, 0, 0)))
    with open(frames, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow("vx,vy,vz,nx,ny,nz,gx,gy,gz".split(","))
        table.writerows(numpy.concatenate([to_rowland(view), normal, across], -1).reshape(-1, 9))
    program = rowland_folder.find_program("rowland-trade")
    command = [program, "evaluate", "--material", material_file, "--probe", sky, "--probe-mapping", "equirect",
               "--method", "reference", "--frames", frames]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    xyz = numpy.array([[float(v) for v in row] for row in list(csv.reader(printed.splitlines()))[1:]])
    return (xyz @ RGB_OF_XYZ.T).clip(0).reshape(SIZE, SIZE, 3)


folder, *materials = sys.argv[sys.argv.index("--") + 1:]
folder = Path(folder)
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="cycles")
bpy.ops.preferences.addon_enable(module="rowland_diffraction")
write_sky(folder / "sky.hdr")
plane = make_scene(folder / "sky.hdr")
for file in materials:
    name = Path(file).stem
    found = render_orders(plane, file, folder / f"{name}.exr")
    true = reference(file, folder / "sky.hdr", folder / f"{name}.csv")
    print(f"{name}: relative RMS {100 * numpy.sqrt(((found - true) ** 2).mean() / (true ** 2).mean()):.1f}, "
          f"mean {found.mean((0, 1)) / true.mean((0, 1))} of the reference's")
