"""Every OBJ and GLB of a folder through trimesh and MeshLab, compared with `penstemon check --json`.

All three must count the same. Files must also be clean, unless their name begins with `broken_`: those are there to see
that the three agree on what is wrong.

GLB repeats a vertex for each normal and UV, so vertices at exactly one place are welded first, mesh by mesh; OBJ shares
its points and is taken as it is.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy
import pymeshlab
import trimesh


def ours(path):
    """What `penstemon check` counts."""
    run = subprocess.run([os.environ["PENSTEMON"], "check", str(path), "--json"], capture_output=True, text=True)
    if not run.stdout:
        raise SystemExit(f"{path}: {run.stderr.strip()}")
    return json.loads(run.stdout)


def obj_arrays(path):
    """Points and faces of an OBJ file of triangles, by its own point indices."""
    points, faces = [], []
    for line in path.read_text().splitlines():
        key, *rest = line.split() or [""]
        if key == "v":
            points.append([float(x) for x in rest[:3]])
        elif key == "f":
            faces.append([int(corner.split("/")[0]) - 1 for corner in rest])
    return numpy.array(points), numpy.array(faces)


def welded(positions, faces):
    """Vertices at exactly one place made one point."""
    points, index = numpy.unique(positions, axis=0, return_inverse=True)
    return points, index.reshape(-1)[faces]


def pieces(path):
    """Each space of points as (points, faces)."""
    if path.suffix == ".obj":
        return [obj_arrays(path)]
    scene = trimesh.load_scene(path, process=False, merge_primitives=True)
    return [welded(numpy.asarray(mesh.vertices), numpy.asarray(mesh.faces)) for mesh in scene.geometry.values()]


def whole(path, parts):
    """Everything as one (points, faces), parts of a GLB where its nodes place them."""
    if path.suffix == ".obj":
        return parts[0]
    mesh = trimesh.load_scene(path, process=False, merge_primitives=True).to_mesh()
    return welded(numpy.asarray(mesh.vertices), numpy.asarray(mesh.faces))


def crossing_faces(mesh):
    """Faces that pass through others of the whole model, as MeshLab sees them."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(*mesh))
    meshes.apply_filter("compute_selection_by_self_intersections_per_face")
    return meshes.current_mesh().selected_face_number()


def by_trimesh(parts):
    counts = {"watertight": True, "winding": True, "outward": True, "components": 0, "non_manifold_edges": 0}
    for points, faces in parts:
        mesh = trimesh.Trimesh(points, faces, process=False)
        counts["watertight"] &= mesh.is_watertight
        counts["winding"] &= mesh.is_winding_consistent
        faces_of_edge = numpy.unique(mesh.edges_sorted, axis=0, return_counts=True)[1]
        counts["non_manifold_edges"] += int((faces_of_edge > 2).sum())
        groups = trimesh.graph.connected_components(mesh.face_adjacency, nodes=numpy.arange(len(faces)))
        counts["components"] += len(groups)
        if mesh.is_watertight and mesh.is_winding_consistent:
            counts["outward"] &= all(mesh.submesh([g], append=True, repair=False).volume >= -1e-15 for g in groups)
    return counts


def by_meshlab(parts):
    keys = {
        "boundary_edges": "boundary_edges",
        "non_manifold_vertices": "non_two_manifold_vertices",
        "components": "connected_components_number",
        "triangles": "faces_number",
    }
    counts = dict.fromkeys([*keys, "duplicate_faces", "zero_area_faces"], 0) | {"any_non_manifold_edge": False}
    for points, faces in parts:
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(points, faces))
        measures = meshes.get_topological_measures()
        for key, theirs in keys.items():
            counts[key] += measures[theirs]
        # MeshLab counts an edge of three faces once or thrice, depending on their order, so only any or none is asked.
        counts["any_non_manifold_edge"] |= measures["non_two_manifold_edges"] > 0
        before = meshes.current_mesh().face_number()
        meshes.apply_filter("meshing_remove_duplicate_faces")
        distinct = meshes.current_mesh().face_number()
        meshes.apply_filter("meshing_remove_null_faces")
        counts["duplicate_faces"] += before - distinct
        counts["zero_area_faces"] += distinct - meshes.current_mesh().face_number()
    return counts


def readable_as_file(path):
    """Whether the two programs' own readers find the same number of triangles."""
    scene = trimesh.load_scene(path)
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    return {
        "trimesh": sum(len(mesh.faces) for mesh in scene.geometry.values()),
        "MeshLab": sum(meshes.mesh(layer.id()).face_number() for layer in meshes),
    }


def disagreements(path):
    report = ours(path)
    parts = pieces(path)
    found = []

    def same(who, what, theirs, mine):
        if theirs != mine:
            found.append(f"{what}: {who} says {theirs}, penstemon {mine}")

    theirs = by_trimesh(parts)
    cracks = report["boundary_edges"] + report["non_manifold_edges"]
    turned = report["flipped_faces"] + report["unorientable_edges"]
    same("trimesh", "non-manifold edges", theirs["non_manifold_edges"], report["non_manifold_edges"])
    same("trimesh", "watertight", bool(theirs["watertight"]), cracks == 0)
    if cracks == 0:
        same("trimesh", "winding", bool(theirs["winding"]), turned == 0)
        same("trimesh", "components", theirs["components"], report["components"])
    if cracks + turned == 0:
        same("trimesh", "outward", bool(theirs["outward"]), report["inside_out_components"] == 0)
    mine = report | {"any_non_manifold_edge": report["non_manifold_edges"] > 0}
    theirs = by_meshlab(parts)
    # Where too many faces lie over each other, penstemon counts none.
    crossing = mine["crossing_faces"]
    if crossing is not None and not path.name.startswith("broken_"):
        seen = crossing_faces(whole(path, parts))
        # Faces that just touch, as in the middle of flowers, count for one and not for the other.
        if abs(seen - crossing) > 4 + 0.15 * max(seen, crossing):
            found.append(f"faces that cross: MeshLab says {seen}, penstemon {crossing}")
    for key, value in theirs.items():
        same("MeshLab", key, value, mine[key])
    if not path.name.startswith("broken_"):
        for who, triangles in readable_as_file(path).items():
            same(who, "triangles read", triangles, report["triangles"])
    if report["clean"] == path.name.startswith("broken_"):
        found.append("should be broken" if report["clean"] else f"should be clean: {report}")
    return report, found


def main(folder):
    files = sorted(p for p in Path(folder).iterdir() if p.suffix in (".obj", ".glb"))
    if not files:
        raise SystemExit(f"no models in {folder}")
    failed = 0
    for path in files:
        report, found = disagreements(path)
        failed += bool(found)
        summary = f"{report['triangles']} triangles, {report['components']} components"
        print(f"{'FAIL' if found else 'ok  '} {path.name}: {summary}")
        for line in found:
            print(f"       {line}")
    return 1 if failed else 0


sys.exit(main(sys.argv[1]))
