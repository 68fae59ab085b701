#!/usr/bin/env python3
"""Makes the models of this folder, always the same bytes: plain Python, no randomness, no clock.

Every model is a closed surface without self-crossings, in metres, y up (except where a format is
there to show another unit or axis), 0.3 to 1 m in size. `models.json` says what each one is meant
to be: components, cavities, genus, and volume and centre of mass from this script's own sums.

    python3 make_models.py [FOLDER]      writes the models next to this file, or into FOLDER
"""
import json
import math
import os
import struct
import sys

TAU = 2 * math.pi


def float32(x):
    """The single-precision neighbour: what every format here can carry without loss."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b))


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scale(a, k):
    return (a[0] * k, a[1] * k, a[2] * k)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scale(a, 1 / math.sqrt(dot(a, a)))


class Mesh:
    def __init__(self):
        self.vertices = []
        self.faces = []  # triangles, counter-clockwise from outside

    def join(self, other):
        base = len(self.vertices)
        self.vertices += other.vertices
        self.faces += [tuple(base + i for i in f) for f in other.faces]
        return self

    def flipped(self):
        self.faces = [(a, c, b) for a, b, c in self.faces]
        return self

    def moved(self, offset):
        self.vertices = [add(v, offset) for v in self.vertices]
        return self

    def rounded(self):
        self.vertices = [tuple(float32(x) for x in v) for v in self.vertices]
        return self

    def moments(self):
        """Volume and centre of mass from signed tetrahedra, summed without rounding."""
        volumes, firsts = [], ([], [], [])
        for f in self.faces:
            a, b, c = (self.vertices[i] for i in f)
            v = dot(a, cross(b, c)) / 6
            volumes.append(v)
            for k in range(3):
                firsts[k].append(v * (a[k] + b[k] + c[k]) / 4)
        volume = math.fsum(volumes)
        return volume, [math.fsum(firsts[k]) / volume for k in range(3)]


# --- building blocks ---------------------------------------------------------------------------

def ear_clip(polygon, indices):
    """Triangles of a simple counter-clockwise polygon (2D points, their indices)."""
    points = list(zip(polygon, indices))
    triangles = []

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    while len(points) > 3:
        best = None
        for i in range(len(points)):
            (a, ia), (b, ib), (c, ic) = points[i - 1], points[i], points[(i + 1) % len(points)]
            if turn(a, b, c) <= 1e-12:
                continue
            if any(turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0
                   for p, ip in points if ip not in (ia, ib, ic) and p not in (a, b, c)):
                continue
            # The ear with the best shape: least slivers.
            quality = turn(a, b, c) / max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) ** 2
            if best is None or quality > best[0] + 1e-12:
                best = (quality, i, (ia, ib, ic))
        triangles.append(best[2])
        del points[best[1]]
    triangles.append(tuple(i for _, i in points))
    return triangles


def prism(outline, low, high, hole=None):
    """An outline in the x-y plane (counter-clockwise) drawn out along z; `hole` is clockwise."""
    mesh = Mesh()
    rings = [outline] + ([hole] if hole else [])
    starts = []
    for ring in rings:
        starts.append(len(mesh.vertices))
        mesh.vertices += [(x, y, low) for x, y in ring] + [(x, y, high) for x, y in ring]
    if hole:
        # A slit joins the nearest pair of outline and hole into one polygon.
        i0, j0 = min(((i, j) for i in range(len(outline)) for j in range(len(hole))),
                     key=lambda ij: math.dist(outline[ij[0]], hole[ij[1]]))
        order_out = [(i0 + k) % len(outline) for k in range(len(outline) + 1)]
        order_in = [(j0 + k) % len(hole) for k in range(len(hole) + 1)]
        polygon = [outline[i] for i in order_out] + [hole[j] for j in order_in]
        slots = [(0, i) for i in order_out] + [(1, j) for j in order_in]
    else:
        polygon, slots = list(outline), [(0, i) for i in range(len(outline))]
    caps = ear_clip(polygon, list(range(len(polygon))))
    for a, b, c in caps:
        tri = [starts[slots[k][0]] + slots[k][1] for k in (a, b, c)]
        sizes = [len(rings[slots[k][0]]) for k in (a, b, c)]
        mesh.faces.append((tri[0], tri[2], tri[1]))
        mesh.faces.append(tuple(t + n for t, n in zip(tri, sizes)))
    for ring, start in zip(rings, starts):
        n = len(ring)
        for i in range(n):
            j = (i + 1) % n
            mesh.faces.append((start + i, start + j, start + n + j))
            mesh.faces.append((start + i, start + n + j, start + n + i))
    return mesh


def revolution(profile, segments):
    """A profile of (radius, height), from the lower pole to the upper one, turned about y."""
    mesh = Mesh()
    rows = []
    for radius, height in profile:
        if radius == 0:
            rows.append([len(mesh.vertices)] * segments)
            mesh.vertices.append((0.0, height, 0.0))
        else:
            rows.append(list(range(len(mesh.vertices), len(mesh.vertices) + segments)))
            for k in range(segments):
                angle = TAU * k / segments
                mesh.vertices.append((radius * math.cos(angle), height, -radius * math.sin(angle)))
    for low, high in zip(rows, rows[1:]):
        for k in range(segments):
            j = (k + 1) % segments
            if low[k] != low[j]:
                mesh.faces.append((low[k], low[j], high[j]))
            if high[k] != high[j]:
                mesh.faces.append((low[k], high[j], high[k]))
    return mesh


def tube(path, tangents_from, radius, around):
    """A closed tube along a closed path; the frame is carried along and its twist spread out."""
    n = len(path)
    tangents = [unit(tangents_from(k)) for k in range(n)]
    normal = unit(cross(tangents[0], (0.3, 0.5, 0.8)))
    frames = [normal]
    for k in range(1, n + 1):
        t = tangents[k % n]
        normal = unit(sub(frames[-1], scale(t, dot(frames[-1], t))))
        frames.append(normal)
    side = cross(tangents[0], frames[0])
    twist = math.atan2(dot(frames[n], side), dot(frames[n], frames[0]))
    mesh = Mesh()
    for k in range(n):
        u, w = frames[k], cross(tangents[k], frames[k])
        for j in range(around):
            angle = TAU * j / around - twist * k / n
            r = radius(k / n)
            offset = add(scale(u, r * math.cos(angle)), scale(w, r * math.sin(angle)))
            mesh.vertices.append(add(path[k], offset))
    for k in range(n):
        for j in range(around):
            a, b = k * around + j, k * around + (j + 1) % around
            c, d = ((k + 1) % n) * around + j, ((k + 1) % n) * around + (j + 1) % around
            mesh.faces += [(a, b, d), (a, d, c)]
    return mesh


def icosphere(levels, radius_of):
    """A subdivided icosahedron; radius_of(direction) shapes it."""
    phi = (1 + math.sqrt(5)) / 2
    raw = [(-1, phi, 0), (1, phi, 0), (-1, -phi, 0), (1, -phi, 0), (0, -1, phi), (0, 1, phi),
           (0, -1, -phi), (0, 1, -phi), (phi, 0, -1), (phi, 0, 1), (-phi, 0, -1), (-phi, 0, 1)]
    points = [unit(p) for p in raw]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                middles[key] = len(points)
                points.append(unit(add(points[key[0]], points[key[1]])))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    mesh = Mesh()
    mesh.vertices = [scale(p, radius_of(p)) for p in points]
    mesh.faces = faces
    return mesh


def cells(occupied, cell):
    """The outer skin of a set of grid cells, two triangles a side."""
    mesh, number = Mesh(), {}

    def vertex(p):
        if p not in number:
            number[p] = len(mesh.vertices)
            mesh.vertices.append(tuple(c * cell for c in p))
        return number[p]

    sides = [((1, 0, 0), [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)]),
             ((-1, 0, 0), [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)]),
             ((0, 1, 0), [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)]),
             ((0, -1, 0), [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]),
             ((0, 0, 1), [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]),
             ((0, 0, -1), [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)])]
    for c in sorted(occupied):
        for direction, corners in sides:
            if add(c, direction) in occupied:
                continue
            q = [vertex(add(c, corner)) for corner in corners]
            mesh.faces += [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
    return mesh


# --- the models --------------------------------------------------------------------------------

def l_beam():
    """Two legs at right angles: the centre of mass lies outside the material."""
    return prism([(0, 0), (0.6, 0), (0.6, 0.12), (0.12, 0.12), (0.12, 0.8), (0, 0.8)], -0.1, 0.1)


def torus(ring=0.3, radius=0.1, n=32, m=16):
    mesh = Mesh()
    for i in range(n):
        for j in range(m):
            u, v = TAU * i / n, TAU * j / m
            r = ring + radius * math.cos(v)
            mesh.vertices.append((r * math.cos(u), radius * math.sin(v), -r * math.sin(u)))
    for i in range(n):
        for j in range(m):
            a, b = i * m + j, ((i + 1) % n) * m + j
            c, d = ((i + 1) % n) * m + (j + 1) % m, i * m + (j + 1) % m
            mesh.faces += [(a, b, c), (a, c, d)]
    return mesh


def ball():
    return icosphere(3, lambda p: 0.25)


def hollow_cube():
    """A cube with a cubic hole inside that is not in the middle."""
    outer = cells({(0, 0, 0)}, 0.5)
    inner = cells({(0, 0, 0)}, 0.3).moved((0.15, 0.05, 0.1)).flipped()
    return outer.join(inner).moved((-0.25, -0.25, -0.25))


def hammer():
    """Handle and head from one outline: off-centre and concave."""
    return prism([(-0.03, 0), (0.03, 0), (0.03, 0.5), (0.16, 0.5), (0.18, 0.52), (0.18, 0.62), (0.16, 0.64),
                  (-0.08, 0.64), (-0.22, 0.58), (-0.22, 0.56), (-0.08, 0.5), (-0.03, 0.5)], -0.05, 0.05)


def gear():
    """Twelve teeth and a bore."""
    teeth, outline = 12, []
    for k in range(teeth):
        for share, radius in ((-0.30, 0.24), (-0.16, 0.32), (0.16, 0.32), (0.30, 0.24)):
            angle = TAU * (k + share) / teeth
            outline.append((radius * math.cos(angle), radius * math.sin(angle)))
    bore = [(0.09 * math.cos(-TAU * k / 24), 0.09 * math.sin(-TAU * k / 24)) for k in range(24)]
    return prism(outline, -0.06, 0.06, bore)


def blob():
    """An animal-like lump: a body, a head and two ears as bumps of one radius function."""
    bumps = [((0.2, 0.9, 0.4), 5.0, 0.55), ((0.45, 1.0, 0.25), 30.0, 0.5), ((-0.05, 1.0, 0.3), 30.0, 0.5),
             ((-0.9, -0.1, -0.4), 12.0, 0.25), ((0.5, -0.7, 0.5), 8.0, 0.2), ((-0.4, -0.7, 0.6), 8.0, 0.2)]

    def radius(p):
        r = 1.0
        for direction, sharpness, height in bumps:
            r += height * math.exp(sharpness * (dot(p, unit(direction)) - 1))
        return 0.22 * r

    return icosphere(3, radius)


def star():
    """A five-pointed star, thick in the middle."""
    mesh = Mesh()
    ring = []
    for k in range(10):
        radius = 0.45 if k % 2 == 0 else 0.18
        angle = TAU / 4 + TAU * k / 10
        ring.append((radius * math.cos(angle), radius * math.sin(angle), 0.0))
    mesh.vertices = ring + [(0.0, 0.0, 0.14), (0.0, 0.0, -0.14)]
    for k in range(10):
        j = (k + 1) % 10
        mesh.faces += [(k, j, 10), (j, k, 11)]
    return mesh


def bowl():
    """Thick-walled, open to the top: closed as a surface, concave as a body."""
    angles = [TAU / 4 * k / 9 for k in range(1, 10)]
    outer = [(0.3 * math.sin(a), 0.3 - 0.3 * math.cos(a)) for a in angles]
    inner = [(0.25 * math.sin(a), 0.3 - 0.25 * math.cos(a)) for a in reversed(angles)]
    return revolution([(0, 0.0)] + outer + inner + [(0, 0.05)], 32)


def pawn():
    profile = [(0, 0), (0.16, 0), (0.17, 0.03), (0.16, 0.07), (0.12, 0.1), (0.11, 0.13), (0.075, 0.2), (0.06, 0.3),
               (0.065, 0.34), (0.11, 0.355), (0.11, 0.375), (0.065, 0.39)]
    for k in range(2, 9):
        angle = TAU / 2 * k / 9
        profile.append((0.09 * math.sin(angle), 0.46 - 0.09 * math.cos(angle)))
    return revolution(profile + [(0, 0.55)], 24)


def knot():
    """A trefoil of varying thickness: one handle, no symmetry of the mass."""
    n = 96

    def at(t):
        return ((math.sin(t) + 2 * math.sin(2 * t)) * 0.13, (math.cos(t) - 2 * math.cos(2 * t)) * 0.13, -math.sin(3 * t) * 0.13)

    def tangent(k):
        t = TAU * k / n
        return (math.cos(t) + 4 * math.cos(2 * t), -math.sin(t) + 4 * math.sin(2 * t), -3 * math.cos(3 * t))

    return tube([at(TAU * k / n) for k in range(n)], tangent, lambda s: 0.05 + 0.015 * math.cos(TAU * s), 8)


def jack():
    """Three crossed bars of unequal length, from cells: six arms, deep notches."""
    occupied = {(0, 0, 0)}
    for axis, reach in ((0, 4), (1, 3), (2, 2)):
        for k in range(-reach, reach + 1):
            cell = [0, 0, 0]
            cell[axis] = k
            occupied.add(tuple(cell))
    return cells(occupied, 0.1).moved((-0.05, -0.05, -0.05))


# --- formats -----------------------------------------------------------------------------------


def write_obj(mesh, name):
    lines = ["# " + name + ", metres, y up", "o " + name]
    lines += ["v %.9g %.9g %.9g" % tuple(v) for v in mesh.vertices]
    lines += ["f %d %d %d" % (a + 1, b + 1, c + 1) for a, b, c in mesh.faces]
    return ("\n".join(lines) + "\n").encode()


def write_off(mesh, _):
    lines = ["OFF", "%d %d 0" % (len(mesh.vertices), len(mesh.faces))]
    lines += [" ".join("%.9g" % c for c in v) for v in mesh.vertices]
    lines += ["3 " + " ".join(str(i) for i in f) for f in mesh.faces]
    return ("\n".join(lines) + "\n").encode()


def write_stl(mesh, name):
    out = [name.encode().ljust(80, b" "), struct.pack("<I", len(mesh.faces))]
    for f in mesh.faces:
        a, b, c = (mesh.vertices[i] for i in f)
        out.append(struct.pack("<12fH", *unit(cross(sub(b, a), sub(c, a))), *a, *b, *c, 0))
    return b"".join(out)


def write_ply(mesh, name):
    header = ("ply\nformat binary_little_endian 1.0\ncomment %s, metres, y up\nelement vertex %d\n"
              "property float x\nproperty float y\nproperty float z\nelement face %d\n"
              "property list uchar int vertex_indices\nend_header\n" % (name, len(mesh.vertices), len(mesh.faces)))
    body = [struct.pack("<3f", *v) for v in mesh.vertices] + [struct.pack("<B3i", 3, *f) for f in mesh.faces]
    return header.encode() + b"".join(body)


def gltf_parts(mesh, name):
    positions = b"".join(struct.pack("<3f", *v) for v in mesh.vertices)
    indices = b"".join(struct.pack("<3H", *f) for f in mesh.faces)
    indices += b"\0" * (-len(indices) % 4)
    low = [min(v[k] for v in mesh.vertices) for k in range(3)]
    high = [max(v[k] for v in mesh.vertices) for k in range(3)]
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
        "meshes": [{"name": name, "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 4}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(mesh.vertices), "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * len(mesh.faces), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(positions), "target": 34962},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices), "target": 34963}],
        "buffers": [{"byteLength": len(positions) + len(indices)}]}
    return document, positions + indices


def write_gltf(mesh, name):
    import base64
    document, data = gltf_parts(mesh, name)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return (json.dumps(document, indent=1) + "\n").encode()


def write_glb(mesh, name):
    document, data = gltf_parts(mesh, name)
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def write_dae(mesh, name):
    """Centimetres and z up; stored 5 cm off along x, which the node's transform undoes."""
    stored = [(100 * x - 5, -100 * z, 100 * y) for x, y, z in mesh.vertices]
    floats = " ".join("%.9g" % c for v in stored for c in v)
    indices = " ".join(str(i) for f in mesh.faces for i in f)
    return ("""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><created>2000-01-01T00:00:00Z</created><modified>2000-01-01T00:00:00Z</modified>
  <unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g" name="{name}"><mesh>
  <source id="p"><float_array id="pa" count="{floats_count}">{floats}</float_array>
   <technique_common><accessor source="#pa" count="{count}" stride="3">
    <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
   </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="{faces}"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n" name="{name}">
  <translate>5 0 0</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
""".format(name=name, floats=floats, floats_count=3 * len(stored), count=len(stored), faces=len(mesh.faces),
           indices=indices)).encode()


WRITERS = {"obj": write_obj, "off": write_off, "stl": write_stl, "ply": write_ply, "gltf": write_gltf, "glb": write_glb,
           "dae": write_dae}

MODELS = [  # name, format, maker, components, cavities, genus
    ("l_beam", "obj", l_beam, 1, 0, 0),
    ("torus", "stl", torus, 1, 0, 1),
    ("ball", "ply", ball, 1, 0, 0),
    ("hollow_cube", "off", hollow_cube, 2, 1, 0),
    ("hammer", "glb", hammer, 1, 0, 0),
    ("gear", "dae", gear, 1, 0, 1),
    ("blob", "ply", blob, 1, 0, 0),
    ("star", "obj", star, 1, 0, 0),
    ("bowl", "gltf", bowl, 1, 0, 0),
    ("pawn", "stl", pawn, 1, 0, 0),
    ("knot", "glb", knot, 1, 0, 1),
    ("jack", "off", jack, 1, 0, 0),
]


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    os.makedirs(folder, exist_ok=True)
    manifest = []
    for name, extension, maker, components, cavities, genus in MODELS:
        mesh = maker().rounded()
        volume, center = mesh.moments()
        data = WRITERS[extension](mesh, name)
        with open(os.path.join(folder, name + "." + extension), "wb") as file:
            file.write(data)
        manifest.append({"name": name, "file": name + "." + extension,
                         "triangles": len(mesh.faces), "components": components, "cavities": cavities, "genus": genus,
                         "volume": volume, "center": center})
    with open(os.path.join(folder, "models.json"), "w", encoding="utf-8") as file:
        json.dump({"schema": "plumb-models/1", "models": manifest}, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main()
