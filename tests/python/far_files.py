# SPDX-License-Identifier: MIT
"""Small files with a shape anywhere: the same shape far from the origin has to look as it does there."""

import base64
import io
import json
import struct
import urllib.parse
import zipfile
import zlib

SHAPE = [(0, 0, 0), (0.8125, 0.125, 0), (0.25, 0.9375, 0.0625), (0.125, 0.25, 0.71875), (0.375, 0.5, -0.5),
         (1.125, 0.3125, 0.1875)]
FACES = [(0, 1, 3), (1, 2, 3), (2, 0, 3), (1, 0, 4), (2, 1, 4), (0, 2, 4), (1, 5, 2, 3)]
NEAR, FAR = (0.0, 0.0, 0.0), (54598150.375, -43210987.25, 12345678.625)
#: What floats hold of FAR, and the rest.
FLOATS = (54598152.0, -43210988.0, 12345679.0)
REST = (-1.625, 0.75, -0.375)


def add(a, b):
    return tuple(float(x + y) for x, y in zip(a, b))


# FBX: a record is its name, its values and the records in it, None where it has no list of them. A value that is a pair is a
# typed one: an array of doubles (d), floats (f) or integers (i, l), or an integer (I).

def _value(value, packs):
    if isinstance(value, str):  # a name and a class are turned around in a binary file
        text = "\0\1".join(reversed(value.split("::"))).encode()
        return b"S" + struct.pack("<I", len(text)) + text
    if isinstance(value, float):
        return b"D" + struct.pack("<d", value)
    if isinstance(value, int):
        return b"L" + struct.pack("<q", value)
    kind, content = value
    if kind == "I":
        return b"I" + struct.pack("<i", content)
    raw = struct.pack(f"<{len(content)}{'q' if kind == 'l' else kind}", *content)
    stored = zlib.compress(raw) if packs else raw
    return kind.encode() + struct.pack("<III", len(content), packs, len(stored)) + stored


def _record(record, place, word, packs):
    name, values, inner = record
    size, null = struct.calcsize(word), b"\0" * (3 * struct.calcsize(word) + 1)
    stored = b"".join(_value(value, packs) for value in values)
    place += 3 * size + 1 + len(name) + len(stored)
    body = b""
    for each in inner or ():
        body += _record(each, place + len(body), word, packs)
    body += null if inner is not None else b""
    return (struct.pack("<3" + word[-1], place + len(body), len(values), len(stored)) + bytes([len(name)]) +
            name.encode() + stored + body)


def fbx_binary(records, version=7400, packs=False):
    word = "<Q" if version >= 7500 else "<I"
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
    for record in records:
        data += _record(record, len(data), word, packs)
    return (data + b"\0" * (3 * struct.calcsize(word) + 121) +
            bytes.fromhex("f85a8c6adef5d97eece90ce3758f290b"))


def _lines(record, depth):
    name, values, inner = record
    tabs = "\t" * depth
    if values and isinstance(values[0], tuple) and values[0][0] in "difl":
        numbers = values[0][1]
        return f"{tabs}{name}: *{len(numbers)} {{\n{tabs}\ta: {','.join(map(repr, numbers))}\n{tabs}}}\n"
    texts = [f'"{each}"' if isinstance(each, str) else str(each[1]) if isinstance(each, tuple) else repr(each)
             for each in values]
    end = "" if inner is None else " {\n" + "".join(_lines(each, depth + 1) for each in inner) + tabs + "}"
    return f"{tabs}{name}: {','.join(texts)}{end}\n"


def fbx_text(records):
    return ("; FBX 7.4.0 project file\n" + "".join(_lines(record, 0) for record in records)).encode()


def vector(name, place):
    kind = name if name.startswith("Lcl") else "Vector3D"
    return ("P", (name, kind, "", "A", *map(float, place)), None)


def geometry(number, place, name="shape"):
    points = [x for point in SHAPE for x in add(point, place)]
    corners = [i for face in FACES for i in (*face[:-1], -face[-1] - 1)]
    return ("Geometry", (number, "Geometry::" + name, "Mesh"), [
        ("Vertices", (("d", points),), None), ("PolygonVertexIndex", (("i", corners),), None),
        ("GeometryVersion", (("I", 124),), None)])


def model(number, kind, *properties):
    return ("Model", (number, f"Model::m{number}", kind), [("Version", (("I", 232),), None),
                                                             ("Properties70", (), list(properties))])


def attribute(number, kind, *properties):
    return ("NodeAttribute", (number, "NodeAttribute::", kind), [("Properties70", (), list(properties))])


def fbx(objects, connections):
    return [("FBXHeaderExtension", (), [("FBXHeaderVersion", (("I", 1003),), None),
                                        ("FBXVersion", (("I", 7400),), None)]),
            ("Objects", (), objects),
            ("Connections", (), [("C", ("OO" if len(each) == 2 else "OP", *each), None) for each in connections])]


SECOND = 46186158000  # of the clock of an FBX


def curves(number, target, values, prop="Lcl Translation"):
    """The objects and the connections of a movement from one place to another in 2 seconds. A place may have numbers for X
    alone."""
    objects = [("AnimationStack", (number, "AnimStack::move", ""), []), ("AnimationLayer", (number + 1, "AnimLayer::", ""), []),
               ("AnimationCurveNode", (number + 2, "AnimCurveNode::T", ""), [("Properties70", (), [])])]
    links = [(number + 1, number), (number + 2, number + 1), (number + 2, target, prop)]
    for axis, numbers in enumerate(zip(*values)):
        objects.append(("AnimationCurve", (number + 3 + axis, "AnimCurve::", ""), [
            ("Default", (0.0,), None), ("KeyVer", (("I", 4008),), None), ("KeyTime", (("l", (0, 2 * SECOND)),), None),
            ("KeyValueFloat", (("f", tuple(map(float, numbers))),), None), ("KeyAttrFlags", (("i", (4,)),), None),
            ("KeyAttrDataFloat", (("f", (0.0,) * 4),), None), ("KeyAttrRefCount", (("i", (2,)),), None)]))
        links.append((number + 3 + axis, number + 2, "d|" + "XYZ"[axis]))
    return objects, links


def skin(number, mesh, joints):
    """The objects and the connections of a skin. A joint is its model, the numbers of its vertices, and the place of its bind."""
    objects = [("Deformer", (number, "Deformer::", "Skin"), [("Version", (("I", 101),), None)])]
    links = [(number, mesh)]
    for i, (joint, vertices, bind) in enumerate(joints):
        matrices = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *place, 1) for place in (bind, [-x for x in bind])]
        objects.append(("Deformer", (number + 1 + i, "SubDeformer::", "Cluster"), [
            ("Version", (("I", 100),), None), ("Indexes", (("i", tuple(vertices)),), None),
            ("Weights", (("d", (1.0,) * len(vertices)),), None),
            *((name, (("d", tuple(map(float, matrix))),), None)
              for name, matrix in zip(("Transform", "TransformLink"), matrices))]))
        links += [(number + 1 + i, number), (joint, number + 1 + i)]
    return objects, links


# Collada: nodes are text.

MESH = '<instance_geometry url="#m"/>'


def translate(place):
    return "<translate>%r %r %r</translate>" % tuple(map(float, place))


def collada_geometry(place, name="m"):
    points = " ".join(repr(x) for point in SHAPE for x in add(point, place))
    corners = [str(i) for face in FACES for k in range(1, len(face) - 1) for i in (face[0], face[k], face[k + 1])]
    params = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return (f'<geometry id="{name}"><mesh><source id="{name}p"><float_array id="{name}a" count="{3 * len(SHAPE)}">{points}'
            f'</float_array><technique_common><accessor source="#{name}a" count="{len(SHAPE)}" stride="3">{params}</accessor>'
            f'</technique_common></source><vertices id="{name}v"><input semantic="POSITION" source="#{name}p"/></vertices>'
            f'<triangles count="{len(corners) // 3}"><input semantic="VERTEX" source="#{name}v" offset="0"/><p>'
            f'{" ".join(corners)}</p></triangles></mesh></geometry>')


def collada(geometries, nodes, up="Y_UP", libraries="", unit="1"):
    return ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>'
            f'<unit meter="{unit}"/><up_axis>{up}</up_axis></asset>{libraries}<library_geometries>{geometries}</library_geometries>'
            f'<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes><scene>'
            '<instance_visual_scene url="#s"/></scene></COLLADA>').encode()


def zae(document, name, names_it=True, **files):
    """An archive of a document and other files, with a manifest or without one."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        if names_it:
            root = urllib.parse.quote(f"./{name}")
            archive.writestr("manifest.xml", f'<?xml version="1.0"?>\n<!-- a -->\n<dae_root xmlns="x"> {root}\n</dae_root>')
            archive.writestr("other.dae", "no document")
        for path, data in {**files, name: document}.items():
            archive.writestr(path, data)
    return stream.getvalue()


# DXF: pairs of a code and a value.

def _dxf(*pairs):
    return "".join(f"{code:>3}\r\n{value}\r\n" for code, value in pairs)


def _corner(number, place):
    return [(10 * (axis + 1) + number, repr(float(place[axis]))) for axis in range(3)]


def dxf_faces(place, turn=lambda point: point):
    """The shape as faces, each corner turned and then moved."""
    return "".join(_dxf((0, "3DFACE"), (8, "L"),
                        *(pair for i in range(4) for pair in _corner(i, add(turn(SHAPE[face[min(i, len(face) - 1)]]), place))))
                   for face in FACES)


def dxf_lines(place):
    """A line, and a polyline."""
    return (_dxf((0, "LINE"), (8, "L"), *_corner(0, place), *_corner(1, add(place, (0.5, 1.25, 0)))) +
            _dxf((0, "POLYLINE"), (8, "M"), (66, 1), (10, 0), (20, 0), (30, 0)) +
            "".join(_dxf((0, "VERTEX"), (8, "M"), *_corner(0, add(place, point))) for point in SHAPE) + _dxf((0, "SEQEND")))


def dxf_insert(place, name="B", *pairs):
    """An insertion of a block, with more pairs of its own."""
    return _dxf((0, "INSERT"), (8, "L"), (2, name), *_corner(0, place), *pairs)


def dxf_block(name, entities, base=NEAR):
    return _dxf((0, "BLOCK"), (8, "0"), (2, name), *_corner(0, base), (3, name)) + entities + _dxf((0, "ENDBLK"), (8, "0"))


def dxf(entities, blocks=dxf_block("B", dxf_faces(NEAR))):
    return (_dxf((0, "SECTION"), (2, "BLOCKS")) + blocks + _dxf((0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")) + entities +
            _dxf((0, "ENDSEC"), (0, "EOF"))).encode()


# glTF: accessors are arrays of numbers, which a file holds as floats.

class Gltf:
    """A file whose first accessors are the shape: its places, its corners, the one joint of each vertex and its weight."""

    def __init__(self, place=NEAR):
        self.bytes, self.views, self.accessors = b"", [], []
        corners = [face[i] for face in FACES for k in range(1, len(face) - 1) for i in (0, k, k + 1)]
        self.add([add(point, place) for point in SHAPE], "VEC3")
        self.add([[corner] for corner in corners], "SCALAR", ("H", 5123))
        self.add([(point[0] > 0.3, 0, 0, 0) for point in SHAPE], "VEC4", ("B", 5121))
        self.add([(1, 0, 0, 0)] * len(SHAPE), "VEC4")

    def add(self, rows, shape, kind=("f", 5126)):
        data = b"".join(struct.pack(f"<{len(row)}{kind[0]}", *row) for row in rows)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": kind[1], "count": len(rows), "type": shape})
        self.bytes += data + b"\0" * (-len(data) % 4)
        return len(self.accessors) - 1

    def write(self, nodes, binds=None, channels=()):
        """A channel is a node, a path, a way of interpolation, and a value for each of the times 0 and 2."""
        mesh = {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3} if binds is not None else {"POSITION": 0}
        children = {child for node in nodes for child in node.get("children", ())}
        roots = [i for i in range(len(nodes)) if i not in children]
        file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes,
                "meshes": [{"primitives": [{"attributes": mesh, "indices": 1}]}]}
        if binds is not None:
            matrices = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *bind, 1] for bind in binds]
            joints = [i for i, node in enumerate(nodes) if node.get("name", "").startswith("joint")]
            file["skins"] = [{"joints": joints, "inverseBindMatrices": self.add(matrices, "MAT4")}]
        samplers, moves = [], []
        for node, path, way, values in channels:
            samplers.append({"input": self.add([[0], [2]], "SCALAR"), "interpolation": way,
                             "output": self.add(values, "VEC4" if path == "rotation" else "VEC3")})
            moves.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})
        if channels:
            file["animations"] = [{"samplers": samplers, "channels": moves}]
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
        file.update(accessors=self.accessors, bufferViews=self.views, buffers=[{"byteLength": len(self.bytes), "uri": uri}])
        return json.dumps(file).encode()
