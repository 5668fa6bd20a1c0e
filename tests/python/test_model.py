# SPDX-License-Identifier: MIT
"""Models from arrays and from what looks like trimesh."""

import copy
import multiprocessing
import pickle
import re
import struct
import zipfile
import zlib

import numpy as np
import pytest

import rhw
from conftest import model_file

FRONT = rhw.Camera.orbit(0, 0)


def sphere(rows=24, columns=32):
    v, u = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns + 1), indexing="ij")
    vertices = np.stack([np.sin(v) * np.sin(u), np.cos(v), np.sin(v) * np.cos(u)], axis=-1).reshape(-1, 3)
    a = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1)
    faces = np.concatenate([np.stack([a, a + columns + 1, a + columns + 2], 1), np.stack([a, a + columns + 2, a + 1], 1)])
    return vertices, faces, np.stack([u / (2 * np.pi), v / np.pi], axis=-1).reshape(-1, 2)


def test_ids_are_the_faces_given():
    vertices, faces, _ = sphere()
    pictures = rhw.Model(vertices, faces).render(200, outputs=("triangle", "barycentric", "position"))
    seen = pictures["triangle"] > 0
    assert seen.sum() > 10000
    corners = vertices[faces[pictures["triangle"][seen] - 1]]
    weights = pictures["barycentric"][seen][:, :3]
    assert np.allclose((corners * weights[:, :, None]).sum(axis=1), pictures["position"][seen][:, :3], atol=1e-5)


def test_same_as_from_a_file(tmp_path, program):
    """What is made from arrays is drawn as the glTF with the same arrays."""
    import base64
    import json
    vertices, faces, _ = sphere(8, 8)
    normals = vertices.astype(np.float32)
    data = [vertices.astype("<f4").tobytes(), normals.tobytes(), faces.astype("<u4").tobytes()]
    uri = "data:application/octet-stream;base64," + base64.b64encode(b"".join(data)).decode()
    starts = np.cumsum([0] + [len(each) for each in data])
    (tmp_path / "s.gltf").write_text(json.dumps({
        "asset": {"version": "2.0"}, "buffers": [{"uri": uri, "byteLength": int(starts[-1])}],
        "bufferViews": [{"buffer": 0, "byteOffset": int(starts[i]), "byteLength": len(data[i])} for i in range(3)],
        "accessors": [{"bufferView": i, "componentType": 5126, "count": len(vertices), "type": "VEC3",
                       "min": [-1, -1, -1], "max": [1, 1, 1]} for i in range(2)] +
                     [{"bufferView": 2, "componentType": 5125, "count": faces.size, "type": "SCALAR"}],
        "materials": [{"doubleSided": True, "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0.25, "roughnessFactor": 0.5}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}))
    model = rhw.Model(vertices, faces, normals=normals, color=(0.5, 0.25, 0.125), metallic=0.25, roughness=0.5)
    assert model.render(100).png() == program(tmp_path / "s.gltf", "s.png", "--size", "100")


def test_far_from_the_origin(tmp_path, program):
    """Arrays of doubles that float32 would make one point of look as at the origin, and what is told is where they are."""
    vertices = np.array([(0, 0, 0), (0.75, 0.125, 0), (0.25, 0.875, 0.0625), (0.125, 0.25, 0.6875)])
    faces = np.array([(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)])
    place = np.array([54598150.375, -43210987.25, 12345678.625])
    look = dict(outputs=("color", "depth", "position"), ground=True)
    near, far = rhw.Model(vertices, faces), rhw.Model(vertices + place, faces)
    assert not any(near.origin) and near.bounds.dtype == np.float32 and near.nodes[0].world.dtype == np.float32
    assert np.array_equal(far.bounds - place, near.bounds)
    mesh, world = far.meshes[0], far.nodes[0].world
    assert np.array_equal(mesh.vertices[mesh.faces] + world[:3, 3], (vertices + place)[faces])
    a, b = near.render(64, **look), far.render(64, **look)
    assert np.array_equal(a["color"], b["color"]) and np.allclose(a["depth"], b["depth"], rtol=0, atol=1e-6)
    assert a["position"].dtype == np.float32 and b["position"].dtype == np.float64
    hit = a["position"][..., 3] > 0
    assert np.allclose(b["position"][hit] - (*place, 0), a["position"][hit], atol=1e-6) and not b["position"][~hit].any()
    camera = rhw.Camera.look_at(b.view.eye, place + 0.25, fovy=30)
    assert np.array_equal(near.render(64, rhw.Camera.look_at(b.view.eye - place, (0.25, 0.25, 0.25), fovy=30))["color"],
                          far.render(64, camera)["color"])
    assert a.png("position") != b.png("position")  # the text says where
    world = np.eye(4)
    world[:3, 3] = place
    again = _placed(vertices, faces, world)
    assert np.array_equal(again.render(64, **look)["color"], a["color"])
    obj = tmp_path / "far.obj"
    for scale in (1, 1000):  # at the latter doubles have fewer digits than the floats that were drawn
        obj.write_text("".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in vertices + place * scale) +
                       "".join(f"f {i} {j} {k}\n" for i, j, k in faces + 1))
        exr = program(obj, "far.exr", "--output", "position", "--size", "64")
        assert b"positionFromOrigin.X" in exr and b"originToCamera" in exr
        pictures = rhw.load(obj).render(64, outputs="position")
        assert pictures.exr() == exr
    pictures["position"][:9] = 0  # what was changed is written
    assert pictures.exr() != exr


SHAPE = np.array([(0, 0, 0), (0.75, 0.125, 0), (0.25, 0.875, 0.0625), (0.125, 0.25, 0.6875)])
FACES = np.array([(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)])
PLACE = np.array([54598150.375, -43210987.25, 12345678.625])


def _lines(rows, before=""):
    return "".join(before + " ".join(f"{each:.17g}" for each in row) + "\n" for row in rows)


def _files(vertices, faces):
    """A model of one mesh in the formats that have doubles: their names and texts."""
    indices = _lines(faces, "3 ")
    head = f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n" + "".join(f"property double {c}\n" for c in "xyz")
    return {"a.ply": head + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n" +
                     _lines(vertices) + indices,
            "a.off": f"OFF\n{len(vertices)} {len(faces)} 0\n" + _lines(vertices) + indices,
            "a.obj": _lines(vertices, "v ") + _lines(faces + 1, "f "),
            "a.stl": "solid a\n" + "".join("facet normal 0 0 0\nouter loop\n" + _lines(vertices[face], "vertex ") +
                                           "endloop\nendfacet\n" for face in faces) + "endsolid a\n",
            "points.ply": head + "end_header\n" + _lines(vertices),
            "a.xyz": _lines(vertices)}


def _xml(text, rows, names):
    """Elements, the attributes of which are the numbers of a row."""
    return "".join(f"<{text} " + " ".join(f'{name}="{each:.17g}"' for name, each in zip(names, row)) + "/>" for row in rows)


def _threemf(path, vertices, faces):
    model = ('<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
             '<object id="1"><mesh><vertices>' + _xml("vertex", vertices, "xyz") + "</vertices><triangles>" +
             _xml("triangle", faces, ("v1", "v2", "v3")) + "</triangles></mesh></object></resources>"
             '<build><item objectid="1"/></build></model>')
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("_rels/.rels", '<Relationships><Relationship Target="/3D/3dmodel.model" Id="r" Type='
                         '"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", model)


def test_parts_far_from_each_other(tmp_path):
    """Two shapes of one mesh, with a camera near each: both look as one that is alone, and `position` says where they are."""
    pair, faces = np.concatenate((SHAPE, SHAPE + PLACE)), np.concatenate((FACES, FACES + len(SHAPE)))
    alone, both = _files(SHAPE, FACES), _files(pair, faces)
    models = {"arrays": (rhw.Model(SHAPE, FACES), rhw.Model(pair, faces))}
    for name in alone:
        for text, name_of in ((alone[name], tmp_path / f"1{name}"), (both[name], tmp_path / f"2{name}")):
            name_of.write_text(text)
    _threemf(tmp_path / "1a.3mf", SHAPE, FACES)
    _threemf(tmp_path / "2a.3mf", pair, faces)
    models.update((name, (rhw.load(tmp_path / f"1{name}"), rhw.load(tmp_path / f"2{name}"))) for name in (*alone, "a.3mf"))
    for name, (one, two) in models.items():
        assert len(two.nodes) == 2 and not two.warnings, name
        assert two.nodes[0].object == two.nodes[1].object
        for place in (0, PLACE):
            a, b = (model.render(64, rhw.Camera.look_at(np.add((1.5, 1.25, 2), at), np.add([0.375] * 3, at), fovy=40), up="y",
                                 lights="default", outputs=("color", "position"))
                    for model, at in ((one, 0), (two, place)))
            assert np.array_equal(a["color"], b["color"]), name
            hit = b["position"][..., 3] > 0
            assert hit.any() and np.array_equal(hit, a["position"][..., 3] > 0)
            assert np.allclose(b["position"][hit][:, :3] - place, a["position"][hit][:, :3], rtol=0, atol=1e-6), name
    two = models["arrays"][1]
    moved = [two.meshes[node.mesh].vertices[two.meshes[node.mesh].faces] + node.world[:3, 3] for node in two.nodes]
    assert np.array_equal(np.concatenate(moved), pair[faces])


def _exr(data, size):
    """The layers of a square EXR of one part with 32 bits for each channel, in chunks of 16 rows that zlib has packed."""
    at, layers, header = 8, [], {}
    while data[at]:
        name_end = data.index(b"\0", at)
        kind_end = data.index(b"\0", name_end + 1)
        length, = struct.unpack_from("<i", data, kind_end + 1)
        header[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + length]
        at = kind_end + 5 + length
    layers = [each.decode() for each in re.findall(rb"([\w.]+)\0[\0-\2]\0{3}.{12}", header["channels"], re.S)]
    rows = []
    for offset in struct.unpack_from(f"<{(size + 15) // 16}Q", data, at + 1):
        length, = struct.unpack_from("<i", data, offset + 4)
        packed = zlib.decompress(data[offset + 8:offset + 8 + length])
        summed = np.cumsum(np.frombuffer(packed, np.uint8).astype(np.int64) - np.arange(len(packed)).clip(0, 1) * 128)
        halves = summed.astype(np.uint8)
        middle = (len(halves) + 1) // 2
        chunk = np.empty_like(halves)
        chunk[0::2], chunk[1::2] = halves[:middle], halves[middle:]
        rows.append(chunk.view("<f4").reshape(-1, len(layers), size))
    return {layer: np.concatenate(rows)[:, i] for i, layer in enumerate(layers)}


def test_positions_of_a_far_part(tmp_path, program):
    """The EXR of a camera near a far part has what positions count from there: origin and layer make up the file's numbers."""
    pair, faces = np.concatenate((SHAPE, SHAPE + PLACE)), np.concatenate((FACES, FACES + len(SHAPE)))
    path = tmp_path / "pair.ply"
    path.write_text(_files(pair, faces)["a.ply"])
    model = rhw.load(path)
    for place in (np.zeros(3), PLACE):
        eye, target = place + (1.5, 1.25, 2), place + 0.375
        pictures = model.render(64, rhw.Camera.look_at(eye, target, fovy=40), outputs="position")
        camera = ",".join(repr(float(each)) for each in (*eye, *target, 0, 1, 0, 40))
        options = ("--output", "position", "--size", "64", "--camera", camera)
        exr = program(path, "pair.exr", *options)
        assert pictures.exr() == exr and pictures.png("position") == program(path, "pair.png", *options)
        numbers = _exr(exr, 64)
        if place.any():
            origin = np.frombuffer(exr, "<f8", 3, exr.index(b"origin\0v3d\0") + len(b"origin\0v3d\0") + 4)
            from_origin = np.stack([numbers[f"positionFromOrigin.{c}"] for c in "XYZ"], axis=-1)
            hit = numbers["position.A"] > 0
            assert hit.any() and (np.abs(from_origin) < 4).all()
            assert np.array_equal(from_origin[hit] + origin, pictures["position"][hit][:, :3])
        else:
            assert b"origin" not in exr.split(b"positionFromOrigin")[0] and "positionFromOrigin.X" not in numbers


@pytest.mark.parametrize("size", [1e-6, 1e-12])
def test_tiny(size):
    """A model of any size has the shadows of its shape."""
    vertices, faces, _ = sphere(8, 8)
    usual = rhw.Model(vertices, faces, smooth=False).render(64)["color"].astype(int)
    tiny = rhw.Model(vertices * size, faces, smooth=False).render(64)["color"].astype(int)
    assert np.abs(tiny - usual).mean() < 0.1


def _placed(vertices, faces, world):
    """A scene as those of trimesh are, with one node."""
    class Graph:
        nodes_geometry = ["node"]

        def __getitem__(self, node):
            return world, "mesh"

    class Mesh:
        def __init__(self):
            self.vertices, self.faces = vertices, faces

    class Scene:
        geometry, graph = {"mesh": Mesh()}, Graph()

    return rhw.Model(Scene())


def test_colors(square):
    vertices, faces = square
    unlit = dict(unlit=True, color=(1, 1, 1))
    bytes_ = rhw.Model(vertices, faces, face_colors=np.array([[200, 10, 30], [5, 250, 90]], np.uint8), **unlit)
    picture = bytes_.render(40, FRONT, samples=1, tone="none")["color"]
    assert set(map(tuple, picture[10:30, 10:30, :3].reshape(-1, 3))) == {(200, 10, 30), (5, 250, 90)}
    light = rhw.Model(vertices, faces, colors=np.full((4, 3), 0.25), **unlit).render(40, FRONT, outputs="linear")
    assert np.allclose(light["linear"][20, 20], [0.25, 0.25, 0.25, 1], atol=2e-3)  # held in half floats


def test_texture(square):
    vertices, faces = square
    texels = np.zeros((2, 2, 3), np.uint8)
    texels[0, 0], texels[0, 1], texels[1, 0], texels[1, 1] = (250, 0, 0), (0, 250, 0), (0, 0, 250), (250, 250, 0)
    texels = texels.repeat(16, axis=0).repeat(16, axis=1)  # so that filters mix no two of them here
    uv = vertices[:, :2] * (1, -1) + (0, 1)
    model = rhw.Model(vertices, faces, uv=uv, texture=texels, unlit=True, color=(1, 1, 1))
    picture = model.render(80, FRONT, samples=1, tone="none")["color"].astype(int)
    for row, column, wanted in ((20, 20, (250, 0, 0)), (20, 60, (0, 250, 0)), (60, 20, (0, 0, 250)), (60, 60, (250, 250, 0))):
        assert np.abs(picture[row, column, :3] - wanted).max() < 2, (row, column)
    assert model.images[0].texels.shape == (32, 32, 4)


def test_flat_and_smooth():
    vertices, faces, _ = sphere(6, 8)
    flat = rhw.Model(vertices, faces, smooth=False).render(60, outputs="normal")["normal"]
    smooth = rhw.Model(vertices, faces).render(60, outputs="normal")["normal"]
    assert len(np.unique(flat.reshape(-1, 4), axis=0)) < 60 < len(np.unique(smooth.reshape(-1, 4), axis=0))


def test_points_and_lines(square):
    vertices, _ = square
    lines = rhw.Model(vertices, np.array([[0, 1], [1, 2]])).render(40, FRONT, outputs="triangle")["triangle"]
    points = rhw.Model(vertices, np.arange(4)[:, None]).render(40, FRONT, outputs="triangle")["triangle"]
    assert set(np.unique(lines)) == {0, 1, 2} and set(np.unique(points)) == {0, 1, 2, 3, 4}


class Visual:
    def __init__(self, kind=None, **members):
        self.kind = kind
        self.__dict__.update(members)


class Trimesh:
    """What rhw asks of a trimesh.Trimesh."""

    def __init__(self, vertices, faces, visual=None):
        self.vertices, self.faces, self.visual = vertices, faces, visual or Visual()


class Graph(dict):
    nodes_geometry = property(lambda self: list(self))


class Scene:
    def __init__(self, geometry, graph):
        self.geometry, self.graph = geometry, Graph(graph)


def test_trimesh(square):
    vertices, faces = square
    red = np.array([[255, 0, 0, 255]] * 4, np.uint8)
    mesh = Trimesh(vertices.astype(float), faces, Visual("vertex", vertex_colors=red))
    assert np.array_equal(rhw.Model(mesh).meshes[0].colors, [[1, 0, 0, 1]] * 4)
    faced = rhw.Model(Trimesh(vertices, faces, Visual("face", face_colors=red[:2])))
    assert faced.meshes[0].faces.shape == (2, 3)


def test_trimesh_points(square):
    """A cloud of points has no faces."""
    cloud = Visual(vertices=square[0], visual=Visual("vertex", vertex_colors=np.array([[0, 0, 255, 255]] * 4, np.uint8)))
    model = rhw.Model(cloud)
    assert model.meshes[0].faces.shape == (4, 1) and np.array_equal(model.meshes[0].colors, [[0, 0, 1, 1]] * 4)


def test_trimesh_texture(square):
    vertices, faces = square
    image = np.zeros((32, 32, 3), np.uint8)
    image[:16] = 250  # above; trimesh's v points up
    visual = Visual("texture", uv=vertices[:, :2], material=Visual(image=image))
    picture = rhw.Model(Trimesh(vertices, faces, visual), unlit=True).render(80, FRONT, tone="none")["color"]
    assert picture[15, 40, 0] > 200 > 5 > picture[65, 40, 0]


def test_trimesh_materials(square):
    """What glTF says of a material that trimesh has read, colours of a plain one, and what the caller says instead."""
    vertices, faces = square
    told = dict(baseColorFactor=np.array([51, 102, 153, 255], np.uint8), metallicFactor=None, roughnessFactor=0.25,
                emissiveFactor=np.array([0, 0.5, 0]), alphaMode="MASK", baseColorTexture=None)
    mesh = Trimesh(vertices, faces, Visual("texture", uv=None, material=Visual(**told)))
    made = rhw.Model(mesh).materials[0]
    assert np.allclose(made.base_color, (0.2, 0.4, 0.6, 1)) and np.allclose(made.emissive, (0, 0.5, 0))
    assert (made.metallic, made.roughness, made.alpha_mode) == (1, 0.25, "mask")
    floats = Trimesh(vertices, faces, Visual("texture", uv=None, material=Visual(**{**told, "baseColorFactor": np.array([0.2, 0.4, 0.6, 1])})))
    assert np.allclose(rhw.Model(floats).materials[0].base_color, (0.2, 0.4, 0.6, 1))
    said = rhw.Model(mesh, color=(1, 0, 0), metallic=0.5, alpha="opaque").materials[0]
    assert (said.base_color, said.metallic, said.roughness, said.alpha_mode) == ((1, 0, 0, 1), 0.5, 0.25, "opaque")
    plain = Trimesh(vertices, faces, Visual("texture", uv=None, material=Visual(diffuse=np.array([255, 188, 0, 255], np.uint8))))
    assert np.allclose(rhw.Model(plain).materials[0].base_color, (1, 0.5029, 0, 1), atol=1e-4)
    assert rhw.Model(plain).materials[0].roughness == rhw.Model(vertices, faces).materials[0].roughness == np.float32(0.6)


def test_trimesh_itself():
    """Debian 12 has none: where Python has it, what it reads is drawn as what we read."""
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not here, and Debian has none")
    for name in ("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"):
        path = model_file(name)
        theirs, ours = rhw.Model(trimesh.load(path)), rhw.load(path)
        assert len(theirs.nodes) == len(ours.nodes) and np.allclose(theirs.bounds, ours.bounds, atol=1e-3)
        a, b = (model.render(120, rhw.Camera.orbit(30, 20), outputs=("color", "object")) for model in (theirs, ours))
        assert ((a["object"] > 0) == (b["object"] > 0)).mean() > 0.999
        assert np.abs(a["color"].astype(int) - b["color"]).mean() < 2
    assert rhw.Model(trimesh.PointCloud(np.eye(3), colors=[[255, 0, 0]] * 3)).meshes[0].colors[2].tolist() == [1, 0, 0, 1]
    ball = trimesh.creation.icosphere(subdivisions=2)
    ball.visual.face_colors = np.arange(len(ball.faces))[:, None] % [255, 7, 11, 256] * [1, 30, 20, 0] + [0, 0, 0, 255]
    seen = rhw.Model(ball).render(60, outputs="triangle")["triangle"]
    assert 100 < len(np.unique(seen)) <= 1 + len(ball.faces)


def test_trimesh_scene(square):
    vertices, faces = square
    moved = np.eye(4)
    moved[0, 3] = 2
    scene = Scene({"a": Trimesh(vertices, faces)}, {"first": (np.eye(4), "a"), "second": (moved, "a")})
    model = rhw.Model(scene)
    assert [node.name for node in model.nodes] == ["first", "second"] and len(model.meshes) == 1
    assert np.allclose(model.bounds, [[0, 0, 0], [3, 1, 0]])
    assert np.array_equal(model.nodes[1].world, moved.astype(np.float32))
    objects = model.render((90, 30), FRONT, outputs="object")["object"]
    assert set(np.unique(objects)) == {0, 1, 2}


def test_arrays_of_others(square):
    """Buffers, lists and what only speaks DLPack."""
    vertices, faces = square

    class Speaker:
        def __init__(self, array, device=1):
            self.array, self.device = array, device

        def __dlpack__(self, stream=None):
            return self.array.__dlpack__()

        def __dlpack_device__(self):
            return self.device, 0

    wanted = rhw.Model(vertices, faces).render(30, FRONT).png()
    writable = vertices.copy()
    for given in (Speaker(writable), vertices.tolist(), memoryview(vertices), np.asfortranarray(vertices)):
        assert rhw.Model(given, faces.tolist()).render(30, FRONT).png() == wanted
    with pytest.raises(TypeError, match="vertices: must lie in main memory"):
        rhw.Model(Speaker(writable, device=2), faces)
    torch = pytest.importorskip("torch", reason="torch is not installed")
    assert rhw.Model(torch.from_numpy(writable), torch.from_numpy(faces)).render(30, FRONT).png() == wanted


def test_a_pickle_is_the_model(boxes, tmp_path):
    """For multiprocessing: what another process reads is drawn as the model is, wherever its files are by then."""
    picture = np.arange(48, dtype=np.uint8).reshape(4, 4, 3)
    vertices, faces, uv = sphere(6, 8)
    for model in (rhw.load(boxes), rhw.Model(vertices, faces, uv=uv, texture=picture, name="ball")):
        text = pickle.dumps(model)
        again = pickle.loads(text)
        assert again.path == model.path and again.warnings == model.warnings and repr(again) == repr(model)
        assert again.materials == model.materials and np.array_equal(again.bounds, model.bounds)
        assert again.render(64).png() == model.render(64).png()
        assert copy.copy(model) is model and copy.deepcopy([model])[0] is model
        drawn = pickle.loads(pickle.dumps(again.render(32, outputs=("color", "depth"))))
        assert np.array_equal(drawn["depth"], model.render(32, outputs="depth")["depth"])
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            assert np.array_equal(pool.apply(rhw.Model.render, (model, 32))["color"], model.render(32)["color"])


def test_a_pickle_that_is_damaged_is_refused(square):
    make, (version, data) = rhw.Model(*square).__reduce__()
    with pytest.raises(ValueError, match="^pickle: the model is of rhw 0.0.1, and here is rhw "):
        make("0.0.1", data)
    for damaged in (b"", data[:-1], data + b"x", data[:len(data) // 2], bytes(len(data)), b"\xff" * len(data)):
        with pytest.raises(ValueError, match="^model: "):
            make(version, damaged)


def test_pickles_of_cameras_and_environments(square):
    """What a process that draws is given: cameras of every kind, and light."""
    model, pose = rhw.Model(*square), np.eye(4)
    pose[:3, 3] = 1, 2, 20
    cameras = [rhw.Camera.fit(fovy=20, margin=3), rhw.Camera.orbit(30, 20, whole=True), rhw.Camera.look_at((3, 4, 9), (0, 0, 0)),
               rhw.Camera.from_matrix(pose, height=8, near=1), rhw.Camera.intrinsics(60, 62, 31, 30, pose)]
    for camera in [*cameras, rhw.Camera.of_model("none")]:
        again = pickle.loads(pickle.dumps(camera))
        assert repr(again) == repr(camera)
        if camera in cameras:
            assert np.array_equal(again.at(model, (64, 48)).matrix, camera.at(model, (64, 48)).matrix)
    filmed, camera = rhw.load(model_file("glTF2/cameras/Cameras.gltf")), rhw.Camera.of_model(1)
    again = pickle.loads(pickle.dumps(camera))
    assert np.array_equal(again.at(filmed, (64, 48)).matrix, camera.at(filmed, (64, 48)).matrix)
    sky = rhw.Environment(np.random.default_rng(1).random((16, 32, 3), np.float32) * 1000 - 1)
    again = pickle.loads(pickle.dumps(sky))
    assert np.array_equal(again.texels, sky.texels)
    assert model.render(32, environment=again).png() == model.render(32, environment=sky).png()


def test_masked_arrays(square):
    """What is masked has no number: one that nobody meant would be drawn."""
    vertices, faces = square
    masked = np.ma.masked_array(vertices, vertices > 5)
    assert rhw.Model(masked, faces).render(32).png() == rhw.Model(vertices, faces).render(32).png()
    masked[0, 0] = np.ma.masked
    for call in (lambda: rhw.Model(masked, faces), lambda: rhw.Model(list(masked), faces),
                 lambda: rhw.diff.rasterize([[*np.ma.masked_less(np.ones((3, 4)), 2)]], [[0, 1, 2]], (2, 2)),
                 lambda: rhw.Model(vertices, faces, colors=np.ma.masked_less(vertices, 0.5)),
                 lambda: rhw.write_png("never.png", np.ma.masked_less(np.zeros((2, 2, 3), np.uint8), 1)),
                 lambda: rhw.Environment(np.ma.masked_less(np.zeros((2, 2, 3), np.float32), 1)),
                 lambda: rhw.Model(vertices, [[0, 1, np.ma.masked]]), lambda: rhw.Camera.look_at((1, 2, 3), (0.0, np.ma.masked, 2)),
                 lambda: rhw.pipeline.Buffer(masked), lambda: rhw.Camera.look_at((1, 2, 3), np.ma.masked_less([0., 1, 2], 1))):
        with pytest.raises(ValueError, match="^[a-z]+: must have no masked elements; "):
            call()
    with pytest.raises(TypeError, match="^azimuth: must be a number"):
        rhw.Camera.orbit(np.ma.masked)
    within = []
    within.append(within)
    with pytest.raises(TypeError, match="^vertices: cannot be read as an array"):
        rhw.Model(within, faces)


@pytest.mark.filterwarnings("ignore:.*extension VRM")
def test_avatars_of_vrm_0_look_back(tmp_path):
    """Their front, which orbits count from, is where other models have their back."""
    import base64
    import json
    triangle = base64.b64encode(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.5)], "<f4").tobytes()).decode()
    scene = {"asset": {"version": "2.0"}, "extensionsUsed": ["VRM"], "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
             "bufferViews": [{"buffer": 0, "byteLength": 36}],
             "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + triangle}]}
    (tmp_path / "avatar.gltf").write_text(json.dumps(scene))
    del scene["extensionsUsed"]
    (tmp_path / "plain.gltf").write_text(json.dumps(scene))
    avatar, plain = (rhw.load(tmp_path / f"{name}.gltf") for name in ("avatar", "plain"))
    assert avatar.render(32, rhw.Camera.orbit(190, 20)).png() == plain.render(32, rhw.Camera.orbit(10, 20)).png()
