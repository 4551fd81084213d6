"""Approximates a grating in the viewport and in Cycles: a node group with a glossy closure for each order and band of
wavelengths, whose normal mirrors the view into the direction of that order."""

import csv
import functools
import math

import bpy

from . import grating, rowland_folder

GROUP = "Rowland grating"
ORDER_GROUP = "Rowland order"
MOST_CLOSURES = 48  # Cycles takes 64, also for the surface beneath and the mirror
MOST_ORDERS = 6
WAVELENGTHS_NM = range(400, 701, 5)
REC709 = ((3.2404542, -1.5371385, -0.4985314), (-0.969266, 1.8760108, 0.041556), (0.0556434, -0.2040259, 1.0572252))


@functools.cache
def white_light():
    """Linear Rec.709 that each of WAVELENGTHS_NM adds to a white of (1, 1, 1)."""
    def table(name):
        with open(rowland_folder.FOLDER / "engine/colour/data" / name, encoding="utf-8") as file:
            return {float(row[0]): [float(v) for v in row[1:]] for row in list(csv.reader(file))[1:]}
    observer = table("cie1931_2deg_xyz_1nm.csv")
    xyz = [observer[nm] for nm in WAVELENGTHS_NM]
    rgb = [[sum(a * b for a, b in zip(row, one)) for row in REC709] for one in xyz]
    white = [sum(one[i] for one in rgb) for i in range(3)]
    return [[v / w for v, w in zip(one, white)] for one in rgb]


def bessel(order, x):
    angles = [(i + 0.5) * math.pi / 64 for i in range(64)]
    return sum(math.cos(order * angle - x * math.sin(angle)) for angle in angles) / 64


def sinc(x):
    return math.sin(math.pi * x) / (math.pi * x) if x else 1.0


def efficiency(value, order, wavelength_nm):
    """The fraction of the light that an order takes, by scalar theory, of a perfect mirror."""
    profile = value["grating"]["profile"]
    phase = 4 * math.pi * grating.value_at(value, ("cover", "ior"), 1) * profile.get("depth_nm", 0) / wavelength_nm
    if profile["type"] == "slit":
        open_part = profile["width_nm"] / value["grating"]["pitch_nm"]
        return (open_part * sinc(order * open_part)) ** 2
    if profile["type"] == "lamellar":
        duty, contrast = profile["duty"], math.sin(phase / 2) ** 2
        return 4 * (duty * sinc(order * duty)) ** 2 * contrast if order else 1 - 4 * duty * (1 - duty) * contrast
    if profile["type"] == "sinusoidal":
        return bessel(order, phase / 2) ** 2
    return sinc(phase / (2 * math.pi) - order) ** 2


def drawable(value):
    """Whether the node group can show it: grooves that reflect, of a profile with a formula."""
    kind = grating.value_at(value, ("grating", "profile", "type"))
    return kind in ("slit", "lamellar", "sinusoidal", "blazed") and "transmission" not in value


def strongest_orders(value):
    orders = value["grating"].get("orders", [-2, -1, 1, 2])
    if orders == "all":
        most = min(int(2 * value["grating"]["pitch_nm"] / WAVELENGTHS_NM[0]), 50)
        orders = [order for order in range(-most, most + 1) if order]
    return sorted(orders, key=lambda order: -efficiency(value, order, 550))[:MOST_ORDERS]


def lobe_width(value):
    """Standard deviation of s_h + v_h along the grooves; of wide lobes that of the Gaussian of the same peak."""
    lobe = grating.value_at(value, ("grating", "groove_lobe"), "flat")
    if lobe == "flat":
        return 0.8
    if "pits" in lobe:
        return 550 / lobe["pits"]["length_nm"] / math.sqrt(2 * math.pi)
    return lobe.get("sigma", 0.1)


def bands(value):
    """(order, wavelength in nm, width in nm, linear RGB of white light there) for each closure."""
    orders = strongest_orders(value)
    count = min(12, MOST_CLOSURES // len(orders))
    white = white_light()
    cover = 4 * (n := grating.value_at(value, ("cover", "ior"), 1)) / (n + 1) ** 2  # its transmittance
    dye = grating.value_at(value, ("cover", "tint"), (1, 1, 1))
    tint = [metal * (passed * cover) ** 2 for metal, passed in zip(metal_colour(value), dye)]
    edges = [round(i * len(white) / count) for i in range(count + 1)]
    parts = [range(first, end) for first, end in zip(edges, edges[1:])]
    # Closures have no negative colours. Clipped ones would add up to more than white.
    clipped = [sum(max(sum(white[i][c] for i in part), 0) for part in parts) for c in range(3)]
    found = []
    for order in orders:
        for part in parts:
            rgb = [sum(white[i][c] * efficiency(value, order, WAVELENGTHS_NM[i]) for i in part) * tint[c] / clipped[c]
                   for c in range(3)]
            centre = sum(WAVELENGTHS_NM[i] for i in part) / len(part)
            found.append((order, centre, 5 * len(part), [max(v, 0) for v in rgb]))
    return found


def metal_colour(value):
    return grating.METAL_COLOURS.get(value.get("metal"), (1, 1, 1))


class Tree:
    """Adds nodes to a node tree; an argument is a socket or a value."""

    def __init__(self, name, inputs, outputs):
        self.tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        for kind, sockets, node in (("inputs", inputs, "NodeGroupInput"), ("outputs", outputs, "NodeGroupOutput")):
            for title, type_ in sockets.items():
                if hasattr(self.tree, "interface"):  # Blender 4
                    self.tree.interface.new_socket(title, in_out=kind[:-1].upper(), socket_type=f"NodeSocket{type_}")
                else:
                    getattr(self.tree, kind).new(f"NodeSocket{type_}", title)
            setattr(self, kind, self.tree.nodes.new(node))

    def node(self, kind, inputs=(), output=0, **members):
        node = self.tree.nodes.new(f"ShaderNode{kind}")
        for name, value in members.items():
            setattr(node, name, value)
        self.connect(node, inputs)
        return node.outputs[output]

    def connect(self, node, inputs):
        for key, value in (inputs.items() if isinstance(inputs, dict) else enumerate(inputs)):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[key])
            else:
                node.inputs[key].default_value = value

    def math(self, operation, *inputs):
        return self.node("Math", inputs, operation=operation)

    def vector(self, operation, *inputs):
        if operation == "SCALE":  # its factor is the fourth input
            return self.node("VectorMath", {0: inputs[0], 3: inputs[1]}, operation=operation)
        return self.node("VectorMath", inputs, 1 if operation == "DOT_PRODUCT" else 0, operation=operation)

    def add(self, shaders):
        """The sum of shaders."""
        total = shaders[0]
        for one in shaders[1:]:
            total = self.node("AddShader", (total, one))
        return total


def order_group():
    """A closure that mirrors the view into one order: s_p + v_p = k g, with k = m lambda / pitch. Its lobe has the peak
    of a Gaussian with the standard deviations Width (across the grooves) and Lobe (along them) in s_p + v_p."""
    if found := bpy.data.node_groups.get(ORDER_GROUP):
        return found
    floats = ("View normal", "View grating", "Shift", "Width", "Lobe")
    tree = Tree(ORDER_GROUP, {"Normal": "Vector", "Grating vector": "Vector", **dict.fromkeys(floats, "Float"),
                              "Colour": "Color"}, {"BSDF": "Shader"})
    normal, across, view_normal, view_across, shift, width, lobe, colour = tree.inputs.outputs[:8]
    # s_n^2 = 1 - |k g - v_p|^2
    squared = tree.math("MULTIPLY_ADD", tree.math("SUBTRACT", tree.math("MULTIPLY", view_across, 2.0), shift), shift,
                        tree.math("MULTIPLY", view_normal, view_normal))
    cosine = tree.math("SQRT", tree.math("MAXIMUM", squared, 1e-4))
    upward = tree.vector("SCALE", normal, tree.math("ADD", cosine, view_normal))
    half = tree.vector("NORMALIZE", tree.vector("ADD", upward, tree.vector("SCALE", across, shift)))
    # GGX has the peak 1 / (2 alpha), a Gaussian 1 / (sqrt(2 pi) sigma), of the slope. A slope e moves s_p by 2 e s_n
    # across the grooves, and by 2 e (v . half) along them. Beckmann's anisotropy has no effect in Blender 3.4.
    view = tree.node("NewGeometry", output="Incoming")
    alpha = [tree.math("MINIMUM", tree.math("DIVIDE", tree.math("MULTIPLY", of, math.sqrt(math.pi / 8)), by), 0.9)
             for of, by in ((width, cosine), (lobe, tree.vector("DOT_PRODUCT", view, half)))]
    along = tree.math("MAXIMUM", *alpha)
    roughness = tree.math("POWER", tree.math("MULTIPLY", alpha[0], along), 0.25)
    anisotropy = tree.math("SUBTRACT", 1.0, tree.math("SQRT", tree.math("DIVIDE", alpha[0], along)))
    visible = tree.vector("SCALE", colour, tree.math("GREATER_THAN", squared, 0.0))
    bsdf = tree.node("BsdfAnisotropic", {"Color": visible, "Roughness": roughness, "Anisotropy": anisotropy,
                                         "Normal": half, "Tangent": across}, distribution="GGX")
    tree.connect(tree.outputs, [bsdf])
    return tree.tree


def grating_group(name, fields):
    """Inputs: the surface beneath. Outputs: that surface under the grating, and the listed orders alone."""
    value = fields.object()
    tree = Tree(name, {"Surface": "Shader"}, {"Surface": "Shader", "Orders": "Shader"})
    normal = tree.node("NewGeometry", output="Normal")
    tangent = tree.node("Tangent", direction_type="UV_MAP")
    angle, pitch, present = value.get("grooveRotation", 0.0), 1.0, 1.0
    if fields.groove_image:
        texel = tree.node("SeparateColor", [tree.node("TexImage", image=fields.groove_image, interpolation="Closest",
                                                      extension="EXTEND" if "33071" in fields.sampler else "REPEAT")])
        angle = tree.math("MULTIPLY_ADD", texel, math.pi, angle)
        pitch = tree.math("MULTIPLY", texel.node.outputs[1], 2.0)
        present = tree.math("GREATER_THAN", pitch, 1e-3)
    across = tree.vector("MULTIPLY_ADD", tree.vector("CROSS_PRODUCT", normal, tangent),
                         tree.node("CombineXYZ", [tree.math("SINE", angle)] * 3),
                         tree.vector("SCALE", tangent, tree.math("COSINE", angle)))
    view = tree.node("NewGeometry", output="Incoming")
    shared = {"Normal": normal, "Grating vector": across, "View normal": tree.vector("DOT_PRODUCT", normal, view),
              "View grating": tree.vector("DOT_PRODUCT", across, view), "Lobe": lobe_width(value)}
    closures = []
    taken = [0.0, 0.0, 0.0]
    for order, wavelength_nm, width_nm, rgb in bands(value):
        taken = [t + v for t, v in zip(taken, rgb)]
        per_nm = order / value["grating"]["pitch_nm"]
        closures.append(tree.node("Group", {
            **shared, "Shift": tree.math("DIVIDE", per_nm * wavelength_nm, pitch), "Colour": (*rgb, 1.0),
            "Width": tree.math("DIVIDE", 0.5 * width_nm * abs(per_nm), pitch)}, node_tree=order_group()))
    orders = tree.add(closures)
    mirror = [m * efficiency(value, 0, nm) for m, nm in zip(metal_colour(value), (610, 545, 455))]
    beneath = max(0.0, 1 - sum(t + m for t, m in zip(taken, mirror)) / 3)
    if 0 in strongest_orders(value):
        mirror = (0, 0, 0)
    mirrored = tree.node("BsdfAnisotropic", {"Color": (*mirror, 1.0), "Roughness": 0.02})
    surface = tree.inputs.outputs[0]
    faded = tree.node("MixShader", (1 - beneath, surface))
    all_ = tree.add([faded, mirrored, orders])
    tree.connect(tree.outputs, [tree.node("MixShader", (present, surface, all_)), orders])
    return tree.tree


def update(material):
    """Builds the node group between the material's surface and its output, or removes it, by the panel's checkbox."""
    if not material.use_nodes:
        return
    nodes, links = material.node_tree.nodes, material.node_tree.links
    output = material.node_tree.get_output_node("ALL")
    fields = material.rowland
    node = nodes.get(GROUP)
    old = node and node.node_tree
    wanted = fields.viewport_colours and drawable(fields.object()) and output
    if wanted:
        if node is None:
            node = nodes.new("ShaderNodeGroup")
            node.name = node.label = GROUP
            node.location = output.location
            output.location.x += 220
        surface = next((link.from_socket for link in output.inputs["Surface"].links), None)
        beneath = old and next((link.from_socket for link in node.inputs[0].links), None)
        node.node_tree = grating_group(f"{GROUP} {material.name}", fields)
        source = beneath or (surface if surface and surface.node != node else None)
        if source:
            links.new(source, node.inputs[0])
        links.new(node.outputs["Surface"], output.inputs["Surface"])
    elif node:
        if output and (source := next((link.from_socket for link in node.inputs[0].links), None)):
            links.new(source, output.inputs["Surface"])
            output.location = node.location
        nodes.remove(node)
    if old:
        bpy.data.node_groups.remove(old)
