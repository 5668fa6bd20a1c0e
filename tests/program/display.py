# SPDX-License-Identifier: MIT
"""What is on a display of Xvfb, which keeps its pixels in a file in the form of xwd; for test_view.sh.

display.py serve SCREEN    does what each line of its input says, and answers with a line: 0 and what it prints, or 1 and
                           why not

    seen PICTURE SECONDS      waits until the top left of the screen is the PPM or PGM
    unseen PICTURE SECONDS    until it is something else
    beside PICTURE MASK SECONDS   until there is something else, but only where the mask is black
    explained PICTURE X Y     the picture stands beside an explanation of that pixel, smaller, with a mark; prints the
                              width and height that it has there
    grab WIDTH HEIGHT OUT     writes the top left of the screen as a PPM

display.py freeze PID      says "ready" and stops the next child process of that one for good
"""
import os
import signal
import struct
import sys
import time


class Pixels:
    """Of a picture, RGB, from top to bottom."""

    def __init__(self, width, height, data):
        self.width, self.height, self.data = width, height, data

    def at(self, x, y):
        first = 3 * (y * self.width + x)
        return tuple(self.data[first:first + 3])


def screen(path, width, height):
    with open(path, "rb") as file:
        data = file.read()
    header = struct.unpack(">25I", data[:100])
    start, stride = header[0] + 12 * header[19], header[12]
    rows = bytearray()
    for y in range(height):
        row = data[start + y * stride:start + y * stride + 4 * width]
        rgb = bytearray(3 * width)
        rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
        rows += rgb
    return Pixels(width, height, bytes(rows))


def picture(path):
    with open(path, "rb") as file:
        data = file.read()
    lines = [line for line in data.split(b"\n", 8) if not line.startswith(b"#")]
    width, height = map(int, lines[1].split())
    channels = 3 if lines[0] == b"P6" else 1
    pixels = data[-width * height * channels:]
    return Pixels(width, height, pixels if channels == 3 else bytes(v for v in pixels for _ in range(3)))


def wait(path, wanted, seconds, is_seen):
    drawn = picture(wanted)
    end = time.monotonic() + seconds
    while (screen(path, drawn.width, drawn.height).data == drawn.data) != is_seen:
        assert time.monotonic() < end, f"{wanted} is {'not seen' if is_seen else 'still seen'}"
        time.sleep(0.01)


def wait_beside(path, wanted, mask, seconds):
    drawn, kept = picture(wanted), picture(mask)
    assert any(kept.data), f"{mask} is black"
    end = time.monotonic() + seconds
    while True:
        seen = screen(path, drawn.width, drawn.height).data
        pixels = [slice(i, i + 3) for i in range(0, len(seen), 3)]
        other = [i for i in pixels if seen[i] != drawn.data[i]]
        if other and not any(any(kept.data[i]) for i in other):
            return
        assert time.monotonic() < end, f"{len(other)} pixels are not those of {wanted}"
        time.sleep(0.01)


def white_box(seen, width, top, bottom):
    """Left, top, right and bottom of all that is white."""
    white = [(x, y) for x in range(width) for y in range(top, bottom) if seen.at(x, y) == (255, 255, 255)]
    assert white, f"nothing is marked in rows {top} to {bottom}"
    return tuple(f(column) for f in (min, max) for column in zip(*white))


def explained(path, wanted, x, y):
    drawn = picture(wanted)
    seen = screen(path, drawn.width, drawn.height)
    panel = seen.at(drawn.width - 1, drawn.height - 1)
    width = next(i for i in range(drawn.width)
                 if all(seen.at(i, j) == panel for j in range(0, drawn.height, 7)))
    height = width * drawn.height // drawn.width
    assert width >= drawn.width // 3, f"the picture has {width} columns"

    def is_alike(i, j):
        there = drawn.at((2 * i + 1) * drawn.width // (2 * width), (2 * j + 1) * drawn.height // (2 * height))
        return all(abs(a - b) <= 24 for a, b in zip(seen.at(i, j), there))

    alike = sum(is_alike(i, j) for i in range(width) for j in range(height))
    assert alike > 0.9 * width * height, f"{alike} of {width * height} pixels are those of the picture"
    left, top, right, bottom = white_box(seen, width, 0, height)
    middle = (left + right) / 2, (top + bottom) / 2
    place = (x + 0.5) * width / drawn.width, (y + 0.5) * height / drawn.height
    assert all(abs(a - b) <= 1.5 for a, b in zip(middle, place)), f"the mark is at {middle}, not {place}"
    left, top, right, bottom = white_box(seen, width, height, drawn.height)
    inside = {seen.at(i, j) for i in range(left + 1, right) for j in range(top + 1, bottom)}
    assert right - left > 5 and inside == {drawn.at(x, y)}, f"enlarged is {inside}, not {drawn.at(x, y)}"
    return f"{width} {height}"


def grab(path, width, height, out):
    with open(out, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (width, height) + screen(path, width, height).data)


def freeze(parent):
    end = time.monotonic() + 30
    print("ready", flush=True)
    while time.monotonic() < end:
        for name in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{name}/stat", encoding="utf-8") as file:
                    words = file.read().rsplit(")", 1)[1].split()
                if words[1] == parent:
                    os.kill(int(name), signal.SIGSTOP)
                    return
            except OSError:
                pass  # it has ended
    sys.exit("there was no child")


def answer(display, verb, *arguments):
    if verb in ("seen", "unseen"):
        wait(display, arguments[0], float(arguments[1]), verb == "seen")
    elif verb == "beside":
        wait_beside(display, arguments[0], arguments[1], float(arguments[2]))
    elif verb == "explained":
        return explained(display, arguments[0], int(arguments[1]), int(arguments[2]))
    else:
        grab(display, int(arguments[0]), int(arguments[1]), arguments[2])
    return ""


def serve(display):
    for line in sys.stdin:
        try:
            print(0, answer(display, *line.split()), flush=True)
        except Exception as error:  # whatever it is, the test says it
            print(1, repr(error).replace("\n", " "), flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "serve":
        serve(sys.argv[2])
    else:
        freeze(sys.argv[2])
