# SPDX-License-Identifier: MIT
"""A browser with the page, and what its tests ask: its pictures and numbers, the native library's, a pointer and fingers."""
import base64
import functools
import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.actions.action_builder import ActionBuilder
from selenium.webdriver.common.actions.pointer_input import PointerInput
from selenium.webdriver.common.by import By

CHAPTERS = ["weights", "pixel", "triangle", "floor", "clip", "motion", "depth"]  # those with a pixel that is explained

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "web"))
import serve  # noqa: E402: it stands beside the page


def start_server(folder, isolated=True, types=None):
    """types: of files by their endings, where they are others."""
    server = serve.make_server(folder, isolated=isolated)
    if types:
        handler = server.RequestHandlerClass
        wrong = type("WrongHandler", (handler.func,), {"extensions_map": {**handler.func.extensions_map, **types}})
        server.RequestHandlerClass = functools.partial(wrong, **handler.keywords)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_port}/index.html"


def start_browser():
    options = webdriver.ChromeOptions()
    for option in ["--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--lang=en",
                   "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic"]:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


class PageCase(unittest.TestCase):
    """The arguments of page.py are those of the process."""

    @classmethod
    def setUpClass(cls):
        cls.browser = start_browser()
        cls.url = start_server(sys.argv[1])
        cls.size(1440, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()

    @classmethod
    def size(cls, width, height, touch=False):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": touch}
        cls.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)

    def open(self, behind, url=None):
        """A page anew: a browser does not load it again for what stands behind #."""
        self.browser.get("about:blank")
        self.browser.get((url or self.url) + behind)

    def setUp(self):
        self.open("#pixel")
        self.browser.execute_script("localStorage.clear()")
        self.open("#pixel")
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still' && rhw.views.model")  # nothing grows any more

    def tearDown(self):
        said = [line["message"] for line in self.browser.get_log("browser") if line["level"] == "SEVERE"]
        self.assertEqual(said, [], "the console stays empty")

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    def wait(self, condition, seconds=20):
        end = time.monotonic() + seconds
        while not self.script(f"return Boolean({condition})"):
            self.assertLess(time.monotonic(), end, f"{condition} within {seconds} s")
            time.sleep(0.02)

    def show(self, name):
        self.script(f"document.getElementById('{name}').scrollIntoView();"
                    f"document.querySelector('#{name} .view')?.scrollIntoView({{block: 'nearest'}})")
        if name in CHAPTERS or name == "exercises":
            self.wait(f"rhw.views.{name}?.figure.dataset.drawn === 'still' && rhw.views.{name}.seen")

    def still(self, name="pixel"):
        self.wait(f"rhw.views.{name}.figure.dataset.drawn === 'still'")

    def node(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def middle(self, selector):
        return self.script(f"const b = document.querySelector('{selector}').getBoundingClientRect();"
                           "return [Math.round(b.x + b.width / 2), Math.round(b.y + b.height / 2)]")

    def drag(self, selector, dx, dy, kind="mouse"):
        x, y = self.middle(selector)
        actions = ActionBuilder(self.browser, mouse=PointerInput(kind, kind), duration=20)
        pointer = actions.pointer_action
        pointer.move_to_location(x, y).pointer_down()
        for step in (1, 2, 3, 4):
            pointer.move_to_location(x + dx * step // 4, y + dy * step // 4)
        pointer.pointer_up()
        actions.perform()

    def swipe(self, selector, dy, beside=0):
        """A real finger, which scrolls where it may, so far beside the node's middle."""
        x, y = self.middle(selector)
        x += beside
        point = lambda at: [{"x": x, "y": at}]  # noqa: E731
        touch = lambda kind, points: self.browser.execute_cdp_cmd(  # noqa: E731
            "Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        touch("touchStart", point(y))
        for part in range(1, 11):
            touch("touchMove", point(y + dy * part / 10))
        touch("touchEnd", [])

    def corner(self, number, name="pixel"):
        return self.script(f"return rhw.views.{name}.scene.corners[{number}].at")

    # Against the native library

    def replay(self, name):
        """What the native library makes of the same calls: pixels, and the numbers of the page's pixel as bits."""
        text, pixel = self.script(f"const v = rhw.views.{name};"
                                  "return [v.script, [v.pixel[0] * v.canvas.width, v.pixel[1] * v.canvas.height]]")
        with tempfile.TemporaryDirectory() as folder:
            script, pixels = os.path.join(folder, "script"), os.path.join(folder, "pixels")
            with open(script, "w") as file:
                file.write(text)
            x, y = (str(int(place)) for place in pixel)
            told = subprocess.run([sys.argv[2], script, pixels, x, y], capture_output=True, text=True, check=True)
            with open(pixels, "rb") as file:
                return file.read(), told.stdout.split()

    def check_native(self, name):
        pixels, numbers = self.replay(name)
        shown = self.script(f"const c = rhw.views.{name}.canvas;"
                            "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                            "let s = ''; for (let i = 0; i < d.length; i += 32768)"
                            " s += String.fromCharCode(...d.subarray(i, i + 32768)); return btoa(s)")
        self.assertEqual(base64.b64decode(shown), pixels, f"{name}: the picture has the native library's bytes")
        bits = self.script(f"return Object.values(rhw.views.{name}.numbers).map((n) => Number.isNaN(n) ? 'nan' :"
                           "[...new Uint8Array(new Float64Array([n]).buffer)].map((b) => b))")
        told = [struct.pack("<Q", int(number, 16)) for number in numbers]
        self.assertEqual(len(bits), len(told))
        for mine, theirs in zip(bits, told):
            if mine == "nan":
                self.assertNotEqual(*[struct.unpack("<d", theirs)[0]] * 2)
            else:
                self.assertEqual(bytes(mine), theirs, f"{name}: a number has the native library's bits")

    def open_sample(self):
        self.script("document.getElementById('model').scrollIntoView()")
        self.wait("document.querySelector('#model [data-name=picture] button').hasAttribute('aria-pressed')")
        self.node("#model .sample").click()
        self.wait("document.querySelector('#model .view').dataset.drawn === 'still'", 60)
