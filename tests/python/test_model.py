# SPDX-License-Identifier: MIT
"""Models from arrays and from what looks like trimesh."""

import copy
import multiprocessing
import pickle

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
    obj.write_text("".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in vertices + place) +
                   "".join(f"f {i} {j} {k}\n" for i, j, k in faces + 1))
    exr = program(obj, "far.exr", "--output", "position", "--size", "64")
    assert b"positionFromOrigin.X" in exr and b"originToCamera" in exr
    assert rhw.load(obj).render(64, outputs="position").exr() == exr


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


def test_masked_arrays(square):
    """What is masked has no number: one that nobody meant would be drawn."""
    vertices, faces = square
    masked = np.ma.masked_array(vertices, vertices > 5)
    assert rhw.Model(masked, faces).render(32).png() == rhw.Model(vertices, faces).render(32).png()
    masked[0, 0] = np.ma.masked
    for call in (lambda: rhw.Model(masked, faces), lambda: rhw.Model(list(masked), faces),
                 lambda: rhw.Model(vertices, faces, colors=np.ma.masked_less(vertices, 0.5)),
                 lambda: rhw.write_png("never.png", np.ma.masked_less(np.zeros((2, 2, 3), np.uint8), 1)),
                 lambda: rhw.Environment(np.ma.masked_less(np.zeros((2, 2, 3), np.float32), 1)),
                 lambda: rhw.pipeline.Buffer(masked), lambda: rhw.Camera.look_at((1, 2, 3), np.ma.masked_less([0., 1, 2], 1))):
        with pytest.raises(ValueError, match="^[a-z]+: must have no masked elements; "):
            call()
