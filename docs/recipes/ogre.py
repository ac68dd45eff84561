#!/usr/bin/python3
"""Renders a scene with OGRE 1.12 and its stencil shadow volumes:

  shadowproof check my.glb --name ogre --renderer \\
      'xvfb-run -a /usr/bin/python3 ogre.py {scene} {view} {out} {unlit}'

Needs Debian's python3-ogre-1.12 and xvfb, or a display. Skins and morph targets are not posed, and
files with compressed or sparse geometry are not read. Without shaders of your own, OGRE lights spots
at vertices alone: their cones are not round.
"""
import base64
import glob
import json
import math
import os
import struct
import sys
from pathlib import Path
from urllib.parse import unquote

import Ogre


def read_gltf(file):
    """The JSON of a .gltf or .glb file, and its buffers' bytes."""
    data = file.read_bytes()
    embedded = None
    if data[:4] == b"glTF":
        length = struct.unpack_from("<I", data, 12)[0]
        embedded = data[20 + length + 8:]
        data = data[20:20 + length]
    gltf = json.loads(data)
    buffers = []
    for buffer in gltf.get("buffers", []):
        uri = buffer.get("uri")
        if uri is None:
            buffers.append(embedded)
        elif uri.startswith("data:"):
            buffers.append(base64.b64decode(uri.split(",", 1)[1]))
        else:
            buffers.append((file.parent / unquote(uri)).read_bytes())
    return gltf, buffers


def accessor(gltf, buffers, index):
    """An accessor's elements, as tuples."""
    described = gltf["accessors"][index]
    if "bufferView" not in described or "sparse" in described or described.get("normalized"):
        sys.exit("ogre.py: sparse, compressed and quantized geometry is not read")
    view = gltf["bufferViews"][described["bufferView"]]
    letter = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
    count = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[described["type"]]
    form = struct.Struct("<" + count * letter[described["componentType"]])
    start = view.get("byteOffset", 0) + described.get("byteOffset", 0)
    stride = view.get("byteStride", form.size)
    buffer = buffers[view["buffer"]]
    return [form.unpack_from(buffer, start + i * stride) for i in range(described["count"])]


def product(a, b):
    """Of two matrices of four columns of four."""
    return [[sum(a[k][r] * column[k] for k in range(4)) for r in range(4)] for column in b]


def transformed(m, p):
    return Ogre.Vector3(*(m[0][r] * p[0] + m[1][r] * p[1] + m[2][r] * p[2] + m[3][r] for r in range(3)))


def matrix_of(node):
    if "matrix" in node:
        return [node["matrix"][4 * c:4 * c + 4] for c in range(4)]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turned = [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
              [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
              [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]]
    scale = node.get("scale", (1, 1, 1))
    columns = [[scale[c] * turned[c][r] for r in range(3)] + [0] for c in range(3)]
    return columns + [[*node.get("translation", (0, 0, 0)), 1]]


# Of a mode of glTF the places of triangle i's corners.
CORNERS = {
    4: lambda i: (3 * i, 3 * i + 1, 3 * i + 2),
    5: lambda i: (i, i + 1, i + 2) if i % 2 == 0 else (i, i + 2, i + 1),  # a strip
    6: lambda i: (i + 1, i + 2, 0),  # a fan
}


def primitives(gltf):
    """Each primitive of triangles of the file's scene, and its world matrix."""
    if not gltf.get("scenes"):
        sys.exit("ogre.py: the file has no scene")
    roots = gltf["scenes"][gltf.get("scene", 0)].get("nodes", [])
    waiting = [(index, matrix_of({})) for index in roots]
    while waiting:
        index, parent = waiting.pop()
        node = gltf["nodes"][index]
        world = product(parent, matrix_of(node))
        waiting += [(child, world) for child in node.get("children", [])]
        if "mesh" in node:
            for primitive in gltf["meshes"][node["mesh"]]["primitives"]:
                if primitive.get("mode", 4) in CORNERS and "POSITION" in primitive["attributes"]:
                    yield primitive, world


def is_mirrored(m):
    """Whether triangles are turned over: the determinant is negative."""
    x, y, z = (Ogre.Vector3(*m[c][:3]) for c in range(3))
    return x.crossProduct(y).dotProduct(z) < 0


def normal_of(a, b, c):
    normal = (b - a).crossProduct(c - a)
    normal.normalise()
    return normal


def add_mesh(manager, gltf, buffers, primitive, world, name):
    """Every triangle with corners of its own, and so with its own normal: flat."""
    points = [transformed(world, p)
              for p in accessor(gltf, buffers, primitive["attributes"]["POSITION"])]
    if "indices" in primitive:
        points = [points[i] for i, in accessor(gltf, buffers, primitive["indices"])]
    mode = primitive.get("mode", 4)
    count = len(points) // 3 if mode == 4 else len(points) - 2
    if count < 1:
        return
    two_sided = gltf["materials"][primitive["material"]].get("doubleSided", False) \
        if "material" in primitive else False
    made = manager.createManualObject(name)
    made.begin("White2" if two_sided else "White1", Ogre.RenderOperation.OT_TRIANGLE_LIST)
    for i in range(count):
        a, b, c = (points[k] for k in CORNERS[mode](i))
        corners = (a, c, b) if is_mirrored(world) else (a, b, c)
        normal = normal_of(*corners)
        for point in corners:
            made.position(point)
            made.normal(normal)
        made.triangle(3 * i, 3 * i + 1, 3 * i + 2)
    made.end()
    mesh = made.convertToMesh(name)
    mesh.buildEdgeList()  # it finds corners at one place
    entity = manager.createEntity(name, name)
    entity.setCastShadows(True)
    manager.getRootSceneNode().createChildSceneNode().attachObject(entity)


def white(name, two_sided):
    material = Ogre.MaterialManager.getSingleton().create(name, "General")
    material.setReceiveShadows(True)
    shading = material.getTechnique(0).getPass(0)
    shading.setAmbient(0.3, 0.3, 0.3)
    shading.setDiffuse(0.6, 0.6, 0.6, 1)
    if two_sided:
        shading.setCullingMode(Ogre.CULL_NONE)


def add_light(manager, described):
    light = manager.createLight("light")
    node = manager.getRootSceneNode().createChildSceneNode()
    node.attachObject(light)
    light.setDiffuseColour(1, 1, 1)
    light.setAttenuation(1e9, 1, 0, 0)
    if described["kind"] == "directional":
        light.setType(Ogre.Light.LT_DIRECTIONAL)
    else:
        node.setPosition(*described["position"])
        light.setType(Ogre.Light.LT_POINT)
    if described["kind"] == "spot":
        light.setType(Ogre.Light.LT_SPOTLIGHT)
        cone = Ogre.Radian(2 * math.radians(described["outer_cone_degrees"]))
        light.setSpotlightRange(cone, cone, 0)
    if described.get("direction"):
        node.setDirection(Ogre.Vector3(*described["direction"]), Ogre.Node.TS_WORLD)
    return light


def add_camera(manager, view):
    m = view["camera"]["matrix"]
    camera = manager.createCamera("camera")
    node = manager.getRootSceneNode().createChildSceneNode()
    node.attachObject(camera)
    node.setPosition(*m[12:15])
    x, y, z, w = view["engines"]["ogre"]["camera"]["rotation"]
    node.setOrientation(Ogre.Quaternion(w, x, y, z))
    extent = view["camera"]["extent"]
    if extent:
        camera.setProjectionType(Ogre.PT_ORTHOGRAPHIC)
        camera.setOrthoWindow(extent["width"], extent["height"])
    else:
        camera.setFOVy(Ogre.Radian(view["camera"]["yfov"]))
        camera.setAspectRatio(view["width"] / view["height"])
    camera.setNearClipDistance(view["camera"]["znear"])
    camera.setFarClipDistance(view["engines"]["ogre"]["camera"]["far"] if extent else 0)  # 0: infinite
    return camera


def main():
    scene, view, *outputs = sys.argv[1:]
    view = json.loads(Path(view).read_text())
    gltf, buffers = read_gltf(Path(scene))
    root = Ogre.Root("", "", "")
    plugins = "/usr/lib/*/OGRE"
    for name in ("RenderSystem_GL", "Codec_STBI"):
        found = glob.glob(f"{plugins}/{name}.so*")
        if not found:
            sys.exit(f"ogre.py: {name} is not in {plugins}; install python3-ogre-1.12")
        root.loadPlugin(found[0])
    root.setRenderSystem(root.getAvailableRenderers()[0])
    root.initialise(False)
    options = Ogre.NameValuePairList()
    options["hidden"] = "true"
    root.createRenderWindow("window", 1, 1, False, options)
    groups = Ogre.ResourceGroupManager.getSingleton()
    for folder in glob.glob("/usr/share/OGRE*/Media/ShadowVolume"):
        groups.addResourceLocation(folder, "FileSystem", "OgreInternal")
    groups.initialiseAllResourceGroups()

    manager = root.createSceneManager()
    manager.setAmbientLight(Ogre.ColourValue(1, 1, 1))
    manager.setShadowTechnique(Ogre.SHADOWTYPE_STENCIL_ADDITIVE)
    white("White1", False)
    white("White2", True)
    for number, (primitive, world) in enumerate(primitives(gltf)):
        add_mesh(manager, gltf, buffers, primitive, world, f"part {number}")
    light = add_light(manager, view["light"])
    camera = add_camera(manager, view)

    texture = Ogre.TextureManager.getSingleton().createManual(
        "picture", "General", Ogre.TEX_TYPE_2D, view["width"], view["height"], 1, 0, Ogre.PF_BYTE_RGB,
        Ogre.TU_RENDERTARGET)
    target = texture.getBuffer().getRenderTarget()
    target.setAutoUpdated(False)
    target.addViewport(camera).setBackgroundColour(Ogre.ColourValue(0, 0, 0))
    for number, output in enumerate(outputs):
        light.setVisible(number == 0)
        target.update()
        target.writeContentsToFile(output)
    os._exit(0)  # parts that refer to each other are taken down in no good order


log = Ogre.LogManager()  # outlives what main makes
log.createLog("", True, False, True)  # not on the console, nor in a file
main()
