# SPDX-License-Identifier: MIT
"""Light from a panorama: the bytes of `rhw render --environment`, of files and of arrays."""

import gc
import signal
import sys
import time

import numpy as np
import pytest

import rhw

ROWS, COLUMNS = 16, 32


def sky():
    """(16, 32, 3) of numbers that Radiance's format has exactly: blue above, red at +x, with a small sun."""
    light = np.zeros((ROWS, COLUMNS, 3), np.float32)
    light[:ROWS // 2] = 0.25, 0.5, 1
    light[ROWS // 2:, 12:20] = 1.5, 0.25, 0
    light[3, 25] = 64, 64, 32
    return light


def radiance(light):
    """A file of Radiance, without compression: a mantissa for each channel, and an exponent."""
    exponent = np.frexp(light.max(axis=2))[1]
    mantissa = light / np.exp2(exponent - 8.0)[:, :, None]
    texels = np.concatenate([mantissa, exponent[:, :, None] + 128], 2)
    texels[light.max(axis=2) == 0] = 0
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % light.shape[:2] + texels.astype(np.uint8).tobytes()


@pytest.fixture
def model(box_obj):
    return rhw.load(box_obj)


@pytest.fixture
def hdr(tmp_path):
    (tmp_path / "sky.hdr").write_bytes(radiance(sky()))
    return tmp_path / "sky.hdr"


def test_bytes_of_the_program(box_obj, model, hdr, tmp_path, program):
    """Of one panorama in each form that it may be given in: as all have the same texels, one of them is drawn each way."""
    size, exr = ("--size", "120x90"), tmp_path / "sky.exr"
    for light in (hdr, sky(), sky().astype(">f8")):
        assert np.array_equal(rhw.Environment(light).texels[:, :, :3], sky()), light
    pictures = model.render((120, 90), environment=rhw.Environment(sky().astype(">f8")))
    assert pictures.png() == program(box_obj, "x.png", *size, "--environment", str(hdr))
    assert np.abs(pictures["color"].astype(int) - model.render((120, 90))["color"]).max() > 20
    turned = model.render((120, 90), rhw.Camera.fit(up="z"), environment=str(hdr), environment_rotation=75, up="z",
                          background="environment", lights="none")
    assert turned.png() == program(box_obj, "x.png", *size, "--environment", str(hdr), "--environment-rotation", "75", "--fit",
                                   "--up", "z", "--background", "environment", "--lights", "none")
    light = model.render((40, 20), outputs="linear")
    light.save(exr)
    assert np.array_equal(rhw.Environment(exr).texels[:, :, :3], light["linear"][:, :, :3])
    small = ("--size", "40x30", "--environment", str(exr))
    assert model.render((40, 30), environment=exr).png() == program(box_obj, "x.png", *small)


def test_light_comes_from_where_it_is(square):
    """A wall that faces +z is lit by what lies a quarter beyond the middle of the panorama, and from nowhere else."""
    model = rhw.Model(*square, roughness=1)
    camera = rhw.Camera.look_at((0.5, 0.5, 3), (0.5, 0.5, 0), fovy=10)
    shown = []
    for start in (20, 4):
        light = np.full((ROWS, COLUMNS, 3), 1e-6, np.float32)
        light[4:12, start:start + 8] = 1, 0, 0
        shown.append(model.render(20, camera, environment=light, lights="none", tone="none", background=(0, 0, 0))["color"][10, 10])
    assert shown[0][0] > 200 and shown[0][1] < 10 and shown[1][0] < 100


def test_another_one_at_the_same_place(model):
    """What a scene keeps of a panorama is not taken for that of another one, whatever memory they get."""
    colors = ((1, 0, 0), (0, 1, 0))
    wanted = [model.render(24, environment=np.full((4, 8, 3), color, np.float32), context=rhw.Context(threads=1))["color"]
              for color in colors]
    for number in (0, 1, 0):
        light = np.full((4, 8, 3), colors[number], np.float32)
        assert np.array_equal(model.render(24, environment=light)["color"], wanted[number])
        gc.collect()
    assert np.array_equal(model.render(24)["color"], model.render(24, context=rhw.Context(threads=1))["color"])


@pytest.mark.long
def test_light_is_kept_as_long_as_the_scene_shows_it(model):
    """While a draw makes other light the former is still there, also where the draw fails; then it is let go."""
    skies = [rhw.Environment(np.full((4, 8, 3), shade)) for shade in (0.2, 0.8)]
    context = rhw.Context(threads=1)

    def holders():
        return [sys.getrefcount(sky._panorama) for sky in skies]

    alone = holders()

    def held():
        return [now - before for now, before in zip(holders(), alone)]

    begun = time.process_time()
    model.render(8, environment=skies[0], context=context)
    light = time.process_time() - begun  # most of it goes into making light
    assert held() == [1, 0]
    with pytest.raises(TypeError):
        model.render(8, environment=skies[1], context=context, camera=7)
    assert held() == [1, 0]
    meanwhile = []

    def stop(*_):
        meanwhile.append(held()[0])
        raise KeyboardInterrupt

    def stopped(sky, seconds):  # of processor time
        before = signal.signal(signal.SIGVTALRM, stop)
        try:
            signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
            with pytest.raises(KeyboardInterrupt):
                model.render((16384, 4096), environment=sky, context=context, samples=4)
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            signal.signal(signal.SIGVTALRM, before)

    stopped(skies[1], 2 * light + 0.1)  # the light is made, and the draw has begun
    assert meanwhile == [1] and held() == [0, 1]
    stopped(skies[0], light / 2)  # before it is made, or meanwhile: the scene has the older one, or none
    assert held()[0] == 0
    model.render(8, environment=skies[0], context=context)
    assert held() == [1, 0]
    model.render(8, context=context)
    assert held() == [0, 0]


def test_texels():
    given = np.array([[[1, np.nan, -1], [np.inf, 1e9, 0.5]]], np.float64)
    light = rhw.Environment(given)
    assert light.texels.tolist() == [[[1, 0, 0, 1], [60000, 60000, 0.5, 1]]] and not light.texels.flags.writeable
    assert repr(light) == "<rhw.Environment: 2 x 1>"
    texels = light.texels
    del light
    gc.collect()
    assert texels[0, 0, 0] == 1


@pytest.mark.parametrize("keywords, kind, line", [
    (dict(environment="/nowhere/sky.hdr"), FileNotFoundError, "no such file: '/nowhere/sky.hdr'"),
    (dict(environment=__file__), rhw.Error, "test_environment.py: "),
    (dict(environment="x\0y"), ValueError, "environment: must not have a zero"),
    (dict(environment=7), TypeError, "environment: must be a path, or floats of linear light, not int64"),
    (dict(environment=np.zeros((2, 2, 3), np.uint8)), TypeError, "environment: must be a path, or floats of linear light, not uint8"),
    (dict(environment=np.zeros((2, 3))), ValueError, r"environment: must have the shape \(H, W, 3\) or .*, not \(2, 3\)"),
    (dict(environment=np.zeros((0, 3, 3))), ValueError, r"environment: must have the shape .*, not \(0, 3, 3\)"),
    (dict(environment=np.zeros((1, 20000, 3))), ValueError, r"of 1 to 16384 rows and columns, not \(1, 20000, 3\)"),
    (dict(environment=np.full((2, 2, 3), np.nan)), ValueError, "environment: must be of numbers: none is finite"),
    (dict(background="environment"), ValueError, "background: 'environment' needs an environment"),
    (dict(environment_rotation=float("nan")), ValueError, "environment_rotation: must lie between"),
    (dict(environment_rotation="far"), TypeError, "environment_rotation: must be a number"),
])
def test_bad_input(square, keywords, kind, line):
    with pytest.raises(kind, match=line) as caught:
        rhw.Model(*square).render(8, **keywords)
    assert "\n" not in str(caught.value)


def test_black(square):
    """No light at all is no reason to fail."""
    assert not rhw.Model(*square).render(8, environment=np.zeros((2, 2, 3)), lights="none", background=(0, 0, 0))["color"][..., :3].any()
