"""What Blender makes of a model: objects, polygons and materials, and one frame if a picture is named.

    python blender.py MODEL [PICTURE]

Needs the package bpy, which is Blender itself; so this is a check by hand, see docs/models.md.
"""

import json
import math
import os
import sys
import time

import bpy
from mathutils import Vector

NEUTRAL_SKY = (0.75, 0.8, 0.85, 1)


def imported(path):
    """Loads the model into an empty scene; gives its meshes and the seconds that took."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    begin = time.time()
    if path.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=path)
    else:
        bpy.ops.wm.obj_import(filepath=path)
    return [o for o in bpy.data.objects if o.type == "MESH"], time.time() - begin


def picture_of(node):
    """The first picture that reaches a node."""
    if node.type == "TEX_IMAGE":
        return node.image.name
    sources = (link.from_node for socket in node.inputs for link in socket.links)
    return next(filter(None, map(picture_of, sources)), None)


def factor_of(node):
    """The colour that a picture is multiplied with."""
    colours = (s for s in node.inputs if s.type == "RGBA" and not s.is_linked)
    return next(([round(c, 3) for c in s.default_value[:3]] for s in colours if node.type.startswith("MIX")), None)


def described(material):
    shader = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    base = shader.inputs["Base Color"]
    source = base.links[0].from_node if base.is_linked else None
    number = lambda name: round(shader.inputs[name].default_value, 3)
    return {
        "material": material.name,
        "colour": factor_of(source) if source else [round(c, 3) for c in base.default_value[:3]],
        "picture": picture_of(source) if source else None,
        "roughness": number("Roughness"),
        "specular": number("Specular IOR Level"),
        "transmission": number("Transmission Weight"),
    }


def render(meshes, path):
    corners = [o.matrix_world @ Vector(c) for o in meshes for c in o.bound_box]
    low, high = (Vector(map(pick, *corners)) for pick in (min, max))
    size, toward = (high - low).length, Vector((0.25, -1, 0.25)).normalized()
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    for thing in (scene.camera, sun):
        scene.collection.objects.link(thing)
    scene.camera.location = (low + high) / 2 + toward * size * 1.6
    scene.camera.rotation_euler = (-toward).to_track_quat("-Z", "Y").to_euler()
    scene.camera.data.lens = 60
    scene.camera.data.clip_start, scene.camera.data.clip_end = size * 0.01, size * 10
    sun.rotation_euler = (math.radians(45), 0, math.radians(30))
    sun.data.energy = 3
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = NEUTRAL_SKY
    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples, scene.cycles.use_denoising = 12, False
    scene.render.resolution_x = scene.render.resolution_y = 640
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = os.path.abspath(path)
    bpy.ops.render.render(write_still=True)


def main(model, picture=None):
    meshes, seconds = imported(model)
    polygons = sum(len(o.data.polygons) for o in meshes)
    counts = {"objects": len(bpy.data.objects), "meshes": len(meshes), "polygons": polygons}
    print(json.dumps(counts | {"seconds": round(seconds, 2)}))
    for material in bpy.data.materials:
        if material.node_tree and any(n.type == "BSDF_PRINCIPLED" for n in material.node_tree.nodes):
            print(json.dumps(described(material), ensure_ascii=False))
    if picture:
        render(meshes, picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
