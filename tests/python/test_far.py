# SPDX-License-Identifier: MIT
"""Files far from the origin: they look as they do at the origin, by the pixel."""

import numpy as np
import pytest

import rhw
from far_files import (FAR, FLOATS, MESH, NEAR, REST, Gltf, add, attribute, collada, collada_geometry, curves, dxf,
                       dxf_block, dxf_faces, dxf_insert, dxf_lines, fbx, fbx_binary, fbx_text,
                       geometry, model, skin, translate, vector, zae)


def vertices(place):
    """A geometry that is far, by a model that turns it about itself."""
    return fbx([geometry(10, place), model(11, "Mesh", vector("Lcl Translation", (1, 2, 3)))], [(11, 0), (10, 11)])


def nodes(place):
    """A model that is far below one that is turned."""
    x, y, z = place
    return fbx([geometry(10, NEAR), model(11, "Mesh", vector("Lcl Translation", (x, z, -y)), vector("Lcl Scaling", (2, 1, 1))),
                model(12, "Null", vector("Lcl Rotation", (90, 0, 0)))], [(12, 0), (11, 12), (10, 11)])


def pivots(place):
    """A geometry without a name that turns about a pivot, both far, and has a transform of its own."""
    return fbx([geometry(10, place, ""), model(11, "Mesh", vector("Lcl Rotation", (0, 0, 90)), vector("RotationPivot", place),
                                               vector("GeometricRotation", (0, 90, 0)),
                                               vector("GeometricTranslation", add(place, (-place[2], -place[1], place[0])))),
                model(12, "Mesh", vector("Lcl Scaling", (1, 2, 1)), vector("ScalingPivot", place))],
               [(11, 0), (10, 11), (12, 11), (10, 12)])


def scene(place):
    """A geometry that is far, one of the same name that is not and whose model is, a camera and a light."""
    return fbx([geometry(10, place), geometry(11, NEAR), model(20, "Mesh"),
                model(21, "Mesh", vector("Lcl Translation", add(place, (1.5, 0, 0)))),
                model(22, "Camera", vector("Lcl Translation", add(place, (5, 1, 1))), vector("Lcl Rotation", (0, 180, 0))),
                model(23, "Light", vector("Lcl Translation", add(place, (1, 2, 3)))),
                attribute(30, "Camera", ("P", ("FieldOfView", "FieldOfView", "", "A", 40.0), None)),
                attribute(31, "Light", ("P", ("LightType", "enum", "", "", ("I", 0)), None))],
               [(20, 0), (10, 20), (21, 0), (11, 21), (22, 0), (30, 22), (23, 0), (31, 23)])


def dae_nodes(format):
    return lambda place: collada(collada_geometry(NEAR), format(place))


def upright(place):
    """A place in a file in which z is up, which is turned."""
    return place[0], -place[2], place[1]


LIGHT = ('<library_lights><light id="l"><technique_common><point><color>1 1 1</color><linear_attenuation>0.25'
         '</linear_attenuation></point></technique_common></light></library_lights>')

TWICE = [(41 + axis, 2.0) for axis in range(3)]

#: A name, and what writes a file around a place.
FILES = {
    "text.fbx": lambda place: fbx_text(vertices(place)),
    "text-nodes.fbx": lambda place: fbx_text(nodes(place)),
    "text-pivots.fbx": lambda place: fbx_text(pivots(place)),
    "text-scene.fbx": lambda place: fbx_text(scene(place)),
    "7400.fbx": lambda place: fbx_binary(vertices(place), 7400),
    "7400-packed.fbx": lambda place: fbx_binary(vertices(place), 7400, True),
    "7500.fbx": lambda place: fbx_binary(vertices(place), 7500),
    "7500-packed.fbx": lambda place: fbx_binary(vertices(place), 7500, True),
    "7400-nodes.fbx": lambda place: fbx_binary(nodes(place), 7400, True),
    "7500-pivots.fbx": lambda place: fbx_binary(pivots(place), 7500, True),
    "7500-scene.fbx": lambda place: fbx_binary(scene(place), 7500, True),
    "vertices.dae": lambda place: collada(collada_geometry(place), f"<node>{MESH}</node>"),
    "mark.dae": lambda place: b"\xef\xbb\xbf" + collada(collada_geometry(place), f"<!-- <node> --><node>{MESH}</node>"),
    "translate.dae": dae_nodes(lambda place: f"<node>{translate(place)}<scale>2 1 1</scale>{MESH}</node>"),
    "matrix.dae": dae_nodes(lambda place: "<node><matrix>0 0 1 %r\n0 1 0 %r\n-1 0 0 %r\n0 0 0 1</matrix>%s</node>" %
                            (*place, MESH)),
    "turned.dae": dae_nodes(lambda place: f"<node><rotate>0 0 1 90</rotate>{translate((place[1], -place[0], place[2]))}"
                            f"{MESH}</node>"),
    "nested.dae": dae_nodes(lambda place: f"<node>{translate((1, 2, 3))}<node><node>{translate(place)}{MESH}</node></node>"
                            "</node>"),
    "pivot.dae": lambda place: collada(
        collada_geometry(place), f"<node>{translate((1, 2, 3))}{translate(place)}<rotate>0 0 1 90</rotate>"
        f"{translate([-x for x in place])}{MESH}</node>"),
    "up.dae": lambda place: collada(collada_geometry(NEAR), f"<node>{translate(upright(place))}{MESH}</node>", "Z_UP"),
    "lookat.dae": dae_nodes(lambda place: "<node><lookat>%r %r %r %r %r %r 0 1 0</lookat>%s</node>" %
                            (*place, *add(place, (-3, 0, 4)), MESH)),
    "skew.dae": dae_nodes(lambda place: f"<node>{translate(place)}<skew>45 0 1 0 1 0 0</skew>{MESH}</node>"),
    "unit.dae": lambda place: collada(collada_geometry(NEAR), f"<node>{translate([x / 0.0254 for x in place])}"
                                      f"<scale>40 40 40</scale>{MESH}</node>", unit="0.0254"),
    "named.zae": lambda place: zae(collada(collada_geometry(place), f"<node>{MESH}</node>"), "a b/x.dae"),
    "light.dae": lambda place: collada(
        collada_geometry(NEAR), f"<node>{translate(place)}{MESH}<node>{translate((1, 2, 3))}"
        '<instance_light url="#l"/></node></node>', libraries=LIGHT),
    "faces.dxf": lambda place: dxf(dxf_faces(upright(place))),
    "lines.dxf": lambda place: dxf(dxf_faces(upright(place)) + dxf_lines(add(upright(place), (1, 0, 0)))),
    "insert.dxf": lambda place: dxf(dxf_faces(upright(place)) + dxf_insert(add(upright(place), (1, 0, 0)), "B", *TWICE)),
    "block.dxf": lambda place: dxf(dxf_insert((1, 2, 3), "C"), dxf_block("C", dxf_faces(upright(place)))),
    "nested.dxf": lambda place: dxf(
        dxf_insert(upright(place), "C"), dxf_block("B", dxf_faces(upright(place)), upright(place)) +
        dxf_block("C", dxf_insert(upright(place), "B", (50, 90.0)), upright(place))),
}


def load(folder, name, data, **options):
    (folder / name).write_bytes(data)
    return rhw.load(folder / name, **options)


def assert_same_picture(near, far):
    """Assert that a model at FAR is drawn as the one at NEAR, by the camera of its own and by one in coordinates of the file."""
    assert not near.warnings and not far.warnings and far.unsupported == near.unsupported
    assert not any(near.origin) and min(np.abs(far.origin)) > 1e6
    assert [mesh.name for mesh in far.meshes] == [mesh.name for mesh in near.meshes]
    look = dict(outputs=("color", "position"))
    a, b = near.render(64, **look), far.render(64, **look)
    assert np.array_equal(a["color"], b["color"])
    hit = a["position"][..., 3] > 0
    assert hit.sum() > 200 and np.allclose(b["position"][hit] - (*FAR, 0), a["position"][hit], rtol=0, atol=1e-6)
    eye, target = np.add(near.bounds[1], (2, 1, 3)), near.bounds.mean(0)
    pictures = [each.render(64, rhw.Camera.look_at(eye + place, target + place, fovy=20))["color"]
                for each, place in ((near, NEAR), (far, FAR))]
    assert np.array_equal(*pictures)


@pytest.mark.parametrize("name", FILES)
def test_looks_as_near(tmp_path, name):
    assert_same_picture(*(load(tmp_path, name, FILES[name](place)) for place in (NEAR, FAR)))


def split(place):
    """What floats hold of a place, and the rest."""
    return (FLOATS, REST) if place == FAR else (NEAR, NEAR)


def keys(place):
    """Two keys of a movement. At 0.75 of 2 seconds it is 3, 6 and −3 from a place that floats hold."""
    return [place, add(place, (8, 16, -8))]


def moved(way):
    """A node that a movement of floats brings far away."""
    def write(place):
        floats, rest = split(place)
        values = keys(floats)
        if way == "CUBICSPLINE":  # a value between its tangents
            values = [NEAR, values[0], (4, 8, -4), (4, 8, -4), values[1], NEAR]
        return Gltf().write([{"translation": rest, "children": [1]}, {"mesh": 0}], channels=[(1, "translation", way, values)])
    return write


def turned_far(place):
    """A node that is far below one that a movement turns."""
    x, y, z = place
    turn = (0, 0, 0.5**0.5, 0.5**0.5)
    return Gltf().write([{"children": [1]}, {"mesh": 0, "translation": (y, -x, z)}],
                        channels=[(0, "rotation", "STEP", [turn, turn])])


def skinned(inside, nodes, binds, **more):
    """A skin of which the shape is at a place within the mesh."""
    return Gltf(inside).write([{"mesh": 0, "skin": 0}, *nodes], binds, **more)


def far_joints(place):
    """Joints that are far, and the shape within a mesh far the other way."""
    inside = (65536.0, -32768.0, 0.0) if place == FAR else NEAR
    joints = [{"name": "joint", "translation": add(place, (0, 0, step))} for step in (0, 0.25)]
    return skinned(inside, joints, [[-x for x in inside]] * 2)


def moved_joints(place):
    """Joints that a movement brings far away, of which the shape is bound to one far away, too."""
    floats, rest = split(place)
    nodes = [{"translation": rest, "children": [2, 3]}, {"name": "joint"}, {"name": "joint", "translation": floats}]
    return skinned(NEAR, nodes, [(0, 0, 0.5), NEAR],
                   channels=[(2, "translation", "LINEAR", keys(floats)), (3, "translation", "LINEAR", keys(floats))])


def fbx_moved(place):
    """A model that a movement of floats brings far away, below one that is turned and far."""
    (x, y, z), rest = split(place)
    objects, links = curves(50, 11, keys((y, -x, z)))
    return fbx([geometry(10, NEAR), model(11, "Mesh"), model(12, "Null", vector("Lcl Rotation", (0, 0, 90)),
                                                             vector("Lcl Translation", rest)), *objects],
               [(12, 0), (11, 12), (10, 11), *links])


def fbx_moved_along_x(place):
    """A model that is far and moves along x alone, below one that is turned, and beside one that is far and still."""
    floats, rest = split(place)
    objects, links = curves(50, 11, [(floats[0] + step,) for step in (0, 8)])
    x, y, z = (rest[0], place[1], place[2])
    return fbx([geometry(10, NEAR), geometry(13, place), model(14, "Mesh", vector("Lcl Rotation", (0, 90, 0)),
                                                               vector("RotationPivot", place)),
                model(11, "Mesh", vector("Lcl Translation", place)), model(12, "Null", vector("Lcl Translation", (x, 0, 0))),
                *objects], [(12, 0), (11, 12), (10, 11), (14, 0), (13, 14), *links])


def fbx_turning(place):
    """A model that is far and turns."""
    objects, links = curves(50, 11, [(0, 0, 90), (0, 0, 90)], "Lcl Rotation")
    return fbx([geometry(10, NEAR), model(11, "Mesh", vector("Lcl Translation", place)), *objects],
               [(11, 0), (10, 11), *links])


def fbx_skin(place):
    """A skin of a geometry that is far, of which one joint moves."""
    objects, links = curves(50, 12, keys(NEAR))
    bones, bindings = skin(30, 10, [(12, (0, 1, 2), [-x for x in place]), (13, (3, 4, 5), [-x for x in place])])
    return fbx([geometry(10, place), model(11, "Mesh"), model(12, "LimbNode"),
                model(13, "LimbNode", vector("Lcl Translation", (3, 6, -3))),
                model(14, "Null", vector("Lcl Translation", place)), *bones, *objects],
               [(11, 0), (14, 0), (12, 14), (13, 14), (10, 11), *bindings, *links])


#: A name, and what writes a file in which a shape is brought around a place, or near it, at 0.75 seconds.
MOVED = {
    "linear.gltf": moved("LINEAR"),
    "spline.gltf": moved("CUBICSPLINE"),
    "turned.gltf": turned_far,
    "joints.gltf": far_joints,
    "moved-joints.gltf": moved_joints,
    "moved.fbx": lambda place: fbx_text(fbx_moved(place)),
    "moved-7500.fbx": lambda place: fbx_binary(fbx_moved(place), 7500, True),
    "along-x.fbx": lambda place: fbx_text(fbx_moved_along_x(place)),
    "along-x-7400.fbx": lambda place: fbx_binary(fbx_moved_along_x(place), 7400),
    "turning.fbx": lambda place: fbx_text(fbx_turning(place)),
    "turning-7500.fbx": lambda place: fbx_binary(fbx_turning(place), 7500),
    "skin.fbx": lambda place: fbx_text(fbx_skin(place)),
    "skin-7400.fbx": lambda place: fbx_binary(fbx_skin(place), 7400, True),
}


@pytest.mark.parametrize("name", MOVED)
def test_moves_as_near(tmp_path, name):
    time = None if name == "joints.gltf" else 0.75
    assert_same_picture(*(load(tmp_path, name, MOVED[name](place), time=time) for place in (NEAR, FAR)))


@pytest.mark.parametrize("y", range(1, 5))
def test_moves_past_a_number(tmp_path, y):
    """A movement may pass any number that a node far away is counted by."""
    def write(place):
        floats, rest = split(place)
        objects, links = curves(50, 11, [(floats[0] + step, y) for step in (0, 8)])
        return fbx_text(fbx([geometry(10, NEAR), model(11, "Mesh", vector("Lcl Translation", place)),
                             model(12, "Null", vector("Lcl Translation", (rest[0], place[1], 0))), *objects],
                            [(12, 0), (11, 12), (10, 11), *links]))
    assert_same_picture(*(load(tmp_path, "past.fbx", write(place), time=0.75) for place in (NEAR, FAR)))


def test_collada_movement_is_told(tmp_path):
    """Of a movement of Collada far away assimp has floats, which is told."""
    def source(name, numbers, params):
        names = "".join(f'<param name="{param}" type="float"/>' for param in params)
        return (f'<source id="{name}"><float_array id="{name}a" count="{len(numbers)}">{" ".join(map(repr, numbers))}'
                f'</float_array><technique_common><accessor source="#{name}a" count="2" stride="{len(params)}">'
                f'{names}</accessor></technique_common></source>')
    moves = ('<library_animations><animation>' + source("t", [0.0, 2.0], ["TIME"]) +
             source("v", [*FAR, *add(FAR, (8, 16, -8))], "XYZ") +
             '<sampler id="a"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#v"/></sampler>'
             '<channel source="#a" target="n/w"/></animation></library_animations>')
    nodes = f'<node id="n"><translate sid="w">0 0 0</translate>{MESH}</node>'
    document = collada(collada_geometry(NEAR), nodes, libraries=moves)
    model = load(tmp_path, "moves.dae", document, time=0.75)
    assert "places are up to 4 apart" in str(model.warnings)
    assert np.allclose(model.bounds.mean(0), add(FAR, (3.5, 6.5, -3)), atol=4)


def test_far_on_the_way(tmp_path):
    """Joints and a movement far away that bring a shape back, as far as floats have what brings it."""
    pictures = []
    for floats in (NEAR, FLOATS):
        joints = [{"translation": floats, "children": [2, 3]}, {"name": "joint", "translation": (0.25, 0.5, 0)},
                  {"name": "joint", "translation": (0.25, 0.5, 0.125)}]
        back = [-x for x in floats]
        model = load(tmp_path, "skin.gltf", skinned(NEAR, joints, [back, back]))
        assert not model.warnings and not any(model.origin)
        pictures.append(model.render(64, outputs=("color", "position")))
    assert all(np.array_equal(pictures[0][name], pictures[1][name]) for name in ("color", "position"))


SLOPE = 1.3660254037844386
MATRICES = [  # a transform of Collada, and the rows of a matrix that is the same; those of none are told
    ("<skew>45 0 2 0 3 0 0</skew>", (1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)),
    ("<skew>30 0 1 0 0 1 1</skew>", (1, 0, 0, 0, 0, 1 + SLOPE, -SLOPE, 0, 0, SLOPE, 1 - SLOPE, 0)),  # axes 45 degrees apart
    ("<skew>90 0 1 0 1 0 0</skew>", (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)),
    ("<skew>90 <!-- </skew> --> 0 1 0 1 0 0</skew>", (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)),
    ("<skew sid='a'/>", (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0)),
    ("<lookat>1 2 3 1 2 -5 0 1 7</lookat>", (1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3)),  # an up that leans
    ("<lookat>1 2 3 6 2 3 0 1 0</lookat>", (0, 0, -1, 1, 0, 1, 0, 2, 1, 0, 0, 3)),
]


@pytest.mark.parametrize("transform,rows", MATRICES)
def test_collada_matrices(tmp_path, transform, rows):
    pictures = []
    for text in transform, f"<matrix>{' '.join(map(str, rows))} 0 0 0 1</matrix>":
        model = load(tmp_path, "matrix.dae", collada(collada_geometry(NEAR), f"<node>{text}{MESH}</node>"))
        pictures.append((model.render(64)["color"], model.bounds))
        assert len(model.warnings) == (text == transform and ("90" in text or "/>" in text))
    assert np.array_equal(pictures[0][0], pictures[1][0]) and np.allclose(pictures[0][1], pictures[1][1], atol=1e-6)


def dxf_colored(number):
    return dxf_faces(NEAR).replace("3DFACE\r\n", f"3DFACE\r\n 62\r\n{number}\r\n")


#: A DXF with insertions, and the entities that they draw: turned, scaled and from another base; from below (an extrusion
#: of −z, whose x points to −x), in a block of another and in rows, and with the colour of the insertion around all.
BLOCKS = {
    "base": (dxf(dxf_insert((4, 0, 0), "B", (41, 2.0), (50, 90.0)), dxf_block("B", dxf_faces(NEAR), (1, 0, 0))),
             dxf_faces((4, -2, 0), lambda point: (-point[1], 2 * point[0], point[2]))),
    "below": (dxf(dxf_insert((1, 2, 3), "B", (210, 0.0), (220, 0.0), (230, -1.0))),
              dxf_faces((-1, 2, -3), lambda point: (-point[0], point[1], -point[2]))),
    "rows": (dxf(dxf_insert((1, 0, 0), "a b"), dxf_block("a b", dxf_insert((1, 0, 0), "a c", (70, 2), (71, 2), (44, 3.0),
                                                                         (45, 4.0))) + dxf_block("a c", dxf_faces(NEAR))),
             "".join(dxf_faces((2 + x, y, 0)) for y in (0, 4) for x in (0, 3))),
    "colour": (dxf(dxf_insert(NEAR, "C", (62, 3)), dxf_block("C", dxf_insert(NEAR, "D", (62, 0))) +
                   dxf_block("D", dxf_insert(NEAR, "B", (62, 0))) + dxf_block("B", dxf_colored(0))), dxf_colored(3)),
}


@pytest.mark.parametrize("name", BLOCKS)
def test_blocks(tmp_path, name):
    """Insertions look as the entities that they draw."""
    inserted, entities = BLOCKS[name]
    models = load(tmp_path, "inserted.dxf", inserted), load(tmp_path, "entities.dxf", dxf(entities))
    assert not models[0].warnings and not models[0].unsupported
    assert np.array_equal(*(model.bounds for model in models))
    assert np.array_equal(*(model.render(64)["color"] for model in models))


def test_blocks_of_none(tmp_path):
    """Blocks that insert themselves, or each other too often, are refused, and one that is not there is told."""
    model = load(tmp_path, "none.dxf", dxf(dxf_faces(NEAR) + dxf_insert(NEAR, "Z")))
    assert "insertions of a block that there is not (DXF): left out" in model.unsupported
    twice = dxf_insert(NEAR, "B") * 2
    many = dxf_insert(NEAR, "C", (70, 30000), (71, 30000))
    rows = (70, 256), (71, 256)
    nothing = dxf_block("B", dxf_insert(NEAR, "C", *rows) * 2) + dxf_block("C", "")
    twice_many = dxf_block("B", many) + dxf_block("C", dxf_faces(NEAR))
    for text in dxf_block("B", twice), twice_many, nothing:
        with pytest.raises(rhw.Error, match="inserts blocks into each other more often"):
            load(tmp_path, "often.dxf", dxf(dxf_insert(NEAR, "B", *rows) if text == nothing else twice, text))


def test_parts_far_from_each_other(tmp_path):
    """Geometries and nodes that are far from each other have places of their own."""
    geometries = collada_geometry(NEAR, "m") + collada_geometry(FAR, "n")
    other = translate(add(FAR, FAR))
    parts = [f"<node>{MESH}</node>", '<node><instance_geometry url="#n"/></node>', f"<node>{other}{MESH}</node>"]
    model = load(tmp_path, "parts.dae", collada(geometries, "".join(parts)))
    assert not model.warnings
    pictures = [model.render(64, rhw.Camera.look_at(np.add(at, (2, 1, 3)), np.add(at, 0.25), fovy=20))["color"].astype(int)
                for at in (NEAR, FAR, add(FAR, FAR))]
    assert len(np.unique(pictures[0])) > 20 and np.array_equal(pictures[0], pictures[2])
    assert np.abs(pictures[0] - pictures[1]).max() <= 2  # positions that are counted from elsewhere round otherwise


def test_many_nodes(tmp_path):
    """Nodes of one mesh, of which a sample takes one vertex each, are told apart by their places alone."""
    nodes = "".join(f"<node>{translate(add(FAR, (i, 0, 0)))}<rotate>0 0 1 {360 * (i % 9)}</rotate>{MESH}</node>"
                    for i in range(4000))
    model = load(tmp_path, "many.dae", collada(collada_geometry((0.25, 0, 0)), nodes))
    assert len(model.nodes) == 4000 and not model.warnings
    assert model.bounds[1][0] - model.bounds[0][0] >= 3999


def material(number, red):
    return ("Material", (number, f"Material::m{number}", ""), [
        ("ShadingModel", ("phong",), None), ("Properties70", (), [("P", ("DiffuseColor", "Color", "", "A", red, 0.0, 0.0), None)])])


@pytest.mark.parametrize("place", [NEAR, FAR])
@pytest.mark.parametrize("write", [fbx_text, fbx_binary, lambda records: fbx_binary(records, 7700)])
def test_fbx_without_a_layer_of_materials(write, place, tmp_path):
    """Faces that do not say which of their model's materials they have have the first one."""
    layer = [("LayerElementMaterial", (("I", 0),), [("MappingInformationType", ("AllSame",), None),
                                                    ("ReferenceInformationType", ("IndexToDirect",), None),
                                                    ("Materials", (("i", (1,)),), None)]),
             ("Layer", (("I", 0),), [("LayerElement", (), [("Type", ("LayerElementMaterial",), None),
                                                           ("TypedIndex", (("I", 0),), None)])])]
    second = geometry(11, place)
    second[2].extend(layer)
    path = tmp_path / "a.fbx"
    path.write_bytes(write(fbx([geometry(10, place), second, geometry(12, place), model(20, "Mesh"), model(21, "Mesh"),
                                model(22, "Mesh"), material(30, 1.0), material(31, 0.5)],
                               [(20, 0), (10, 20), (30, 20), (31, 20), (21, 0), (11, 21), (30, 21), (31, 21), (22, 0),
                                (12, 22), (31, 22)])))
    read = rhw.load(path)
    names = [read.materials[read.meshes[node.mesh].material].name for node in read.nodes]
    assert names == ["m30", "m31", "m31"] and not read.warnings and not read.unsupported
    assert (read.origin == NEAR) == (place == NEAR)
