# SPDX-License-Identifier: MIT
"""What the page's chapters ask and answer, held to the numbers of their pixels; and what its address says."""
import base64
import os
import re
import sys
import time

from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import page_programs
from page_case import PageCase


class Lessons(PageCase):
    def test_the_middle_is_asked_for(self):
        self.open("")
        self.wait("window.rhw?.views.first?.figure.dataset.drawn === 'still'")
        shown = lambda part: self.node(f"#first {part}").is_displayed()  # noqa: E731
        self.assertFalse(shown(".after") or shown(".second"), "nothing is told before it is asked")
        self.assertFalse(re.search(r"[0-9]", self.node("#first").text), "and no number")
        before = self.middle("#first .ask .mark")
        self.drag("#first .ask .mark circle:last-child", 60, -60)
        self.assertLess(self.middle("#first .ask .mark")[1], before[1] - 30)
        self.node("#first .look").click()
        self.wait("document.querySelector('#first .verdict').textContent")
        self.assertTrue(shown(".after") and shown(".second"))
        said = {}
        for percent in (5, 50, 98):
            self.script(f"rhw.views.first.restore(new URLSearchParams('mark={percent / 100}&shown=1'))")
            said[percent] = self.node("#first .verdict").text
        self.assertIn("halfway along the line in the picture", said[50])
        self.assertIn("Not so far up", said[98])
        self.assertEqual(len(set(said.values())), 3)
        right = self.script("const [a, b] = [1.3, -5].map((z) => rhw.views.first.stageClip([-1.15, 0, z])[3]); return b / (a + b)")
        self.script(f"rhw.views.first.restore(new URLSearchParams('mark={right}&shown=1'))")
        self.assertIn("That is where it is", self.node("#first .verdict").text)

        def ring_on(picture):  # how far the ring is from where the line across the middle meets the edge
            return self.script(
                "const line = document.querySelectorAll('#first .middle')[arguments[0]].points[0],"
                " at = document.querySelectorAll('#first .ask .mark')[arguments[0]].transform.baseVal[0].matrix;"
                "return Math.hypot(at.e - line.x, at.f - line.y)", picture)
        self.wait("document.querySelectorAll('#first .middle')[1].points.length === 2")
        self.assertLess(ring_on(1), 1.5)
        self.assertGreater(ring_on(0), 20)

        self.size(1200, 704)  # README's picture of the page
        self.script("rhw.views.first.restore(new URLSearchParams('mark=0.5&shown=1')); scrollTo(0, 0)")
        self.wait("document.querySelectorAll('#first .middle')[1].points.length === 2 && rhw.views.first.canvas.width < 640")
        time.sleep(0.5)
        picture = self.browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "webp", "quality": 80})["data"]
        with open(os.path.join(sys.argv[3], "page.webp"), "wb") as file:
            file.write(base64.b64decode(picture))
        self.size(1440, 900)

    def test_shares_are_the_pixels_weights(self):
        self.show("weights")
        areas = ("const area = (p) => Math.abs([0, 1, 2].reduce((sum, i) => sum + p[i].x * p[(i + 1) % 3].y - p[(i + 1) % 3].x * p[i].y, 0));"
                 "const list = [...document.querySelectorAll(arguments[0])].map((node) => area(node.points));"
                 "const all = list.reduce((a, b) => a + b); return list.map((one) => one / all)")

        def check():
            n = self.script("return rhw.views.weights.numbers")
            for shapes, names in (("#weights .view .share", "rst"), ("#weights .straight .share", "abc")):
                for share, name in zip(self.script(areas, shapes), names):
                    self.assertAlmostEqual(share, n[name], delta=0.01)
            for name in "rstabc":
                width = self.script(f"return document.querySelector('#weights .bar [data-term={name}] + span b').style.width")
                self.assertAlmostEqual(float(width.rstrip("%")) / 100, n[name], delta=1e-4)
            return n
        before = check()
        places = self.script("return [...document.querySelectorAll('#weights .view .handle')].map((node) => node.getAttribute('transform'))")
        self.script("document.querySelector('#weights .view .handle.cornerB').focus(); rhw.views.weights.figure.dataset.drawn = ''")
        for _ in range(6):
            self.browser.switch_to.active_element.send_keys(Keys.PAGE_UP)
        self.wait("rhw.views.weights.figure.dataset.drawn === 'still'")
        after = check()
        self.assertLess(after["b"], before["b"] - 0.02)
        self.assertAlmostEqual(after["s"], before["s"], delta=0.002)  # pushed along its ray it is seen where it was
        moved = self.script("return [...document.querySelectorAll('#weights .view .handle')].map((node) => node.getAttribute('transform'))")
        for one, other in zip(places, moved):
            for a, b in zip(re.findall(r"[-0-9.]+", one), re.findall(r"[-0-9.]+", other)):
                self.assertAlmostEqual(float(a), float(b), delta=0.5)
        slide = "const b = document.querySelector('#weights [name=distance]'); b.value = arguments[0]; b.dispatchEvent(new Event('input'))"
        for w in (3, 11):
            self.script("rhw.views.weights.figure.dataset.drawn = ''")
            self.script(slide, w)
            self.wait("rhw.views.weights.figure.dataset.drawn === 'still'")
            pushed = check()
            self.assertAlmostEqual(pushed["W_1"], w, delta=1e-4)
            self.assertAlmostEqual(pushed["s"], before["s"], delta=0.002)
        b = "rhw.views.weights.scene.corners[1].at"
        at = self.script(f"return {b}")
        self.script("rhw.views.weights.moveTo(rhw.views.weights.scene.corners[1], 1000)")  # farther than it may go
        self.assertEqual(self.script(f"return {b}"), at, "it does not leave its ray")
        steps = "[...document.querySelectorAll('#weights .steps > li')].filter((step) => step.offsetHeight > 0).length"
        for count in (1, 2, 3, 4):
            self.assertEqual(self.script(f"return {steps}"), count)
            if count < 4:
                self.node("#weights .next").click()
        self.assertFalse(self.node("#weights .next").is_displayed())

    def test_curves_of_the_edge(self):
        """Two plots at once over the same places: what bends in the one is straight in the other."""
        self.show("inverse")
        self.wait("document.querySelector('#inverse .plot .curve')")
        bends = ("return [...document.querySelectorAll('#inverse .plot')].map((plot) => [...plot.querySelectorAll('.curve')].map(({ points: q }) => {"
                 " const [a, b, m] = [q[0], q[q.length - 1], q[q.length >> 1]];"
                 " return Math.abs(a.y + (b.y - a.y) * (m.x - a.x) / (b.x - a.x) - m.y); }))")
        dots = "return [...document.querySelectorAll('#inverse .plot')].map((plot) => [...plot.querySelectorAll('.value')].map((t) => t.textContent))"
        overlaps = ("return [...document.querySelectorAll('#inverse .plot')].flatMap((plot) => {"
                    " const boxes = [...plot.querySelectorAll('.value, .mark text')].map((text) => [text.textContent, text.getBoundingClientRect()]);"
                    " return boxes.flatMap(([one, a], i) => boxes.slice(i + 1).filter(([, b]) =>"
                    " a.left < b.right && b.left < a.right && a.top + 4 < b.bottom && b.top + 4 < a.bottom).map(([other]) => [one, other])); })")
        captions = self.script("return [...document.querySelectorAll('#inverse .top .caption')].map((text) => text.textContent)")
        self.assertEqual(captions, ["A'", "B'", "eye", "screen"])
        n = self.script("return rhw.views.inverse.numbers()")
        w, u = n["W_P"], n["b"]
        told = {"w": [[w, n["r"] * n["W_A"] + n["s"] * n["W_B"]], [1 / w]], "u": [[1 / w, u / w], [u, n["s"]]]}
        for value, straight in (("w", [[False, True], [True]]), ("u", [[True, True], [False, True]])):
            self.node(f"#inverse button[value='{value}']").click()
            self.assertEqual([[bend < 1 for bend in plot] for plot in self.script(bends)], straight, value)
            for shown, numbers in zip(self.script(dots), told[value]):
                self.assertEqual(len(shown), len(numbers))
                for text, number in zip(shown, numbers):
                    self.assertAlmostEqual(float(text), number, delta=2e-3)
            over = self.script(overlaps)
            self.assertEqual(over, [], f"{value}: every number can be read")
            units = self.script("return [...document.querySelectorAll('#inverse .plot')].map((plot) => plot.textContent)")
            self.assertTrue(all("unit of length" in text or "units of length" in text or "from 0 in A" in text for text in units), units)
        tops = self.script("return [...document.querySelectorAll('#inverse :is(.plot, .top)')].map((node) => node.getBoundingClientRect())"
                           ".map(({ top, bottom }) => [top, bottom])")
        self.assertTrue(max(bottom for _, bottom in tops) - min(top for top, _ in tops) < 850, "all three are seen at once")
        self.assertTrue(self.script("const [key, , below] = ['.key.naive', '.stage', '.stage ~ p'].map((part) => document.querySelector(`#inverse ${part}`));"
                                    "return Boolean(below) && getComputedStyle(key, '::before').backgroundImage.startsWith('repeating')"),
                        "what is wrong is dashed beside its name, too, and the algebra follows the figure")
        before = self.script("return rhw.views.inverse.q")
        places = ("return [...document.querySelectorAll('#inverse .plot .on-curve')].map((dot) => Number(dot.getAttribute('cx')))")
        self.drag("#inverse .plot .mark circle:last-of-type", 60, 0)
        self.assertEqual(len(set(self.script(places))), 1, "the dots stand above each other")
        after = self.script("return rhw.views.inverse.q")
        self.assertGreater(after, before + 0.05)
        place = self.script("const d = rhw.views.inverse, n = d.numbers(); return n.b * d.ends[1][1] + n.a * d.ends[0][1]")
        self.assertAlmostEqual(place, self.script("return rhw.views.inverse.numbers().W_P"), places=9)  # P lies on the edge

    def test_the_program_says_the_same(self):
        """Its values are the pixel's, in three languages; and what stands there runs and gives them."""
        n = self.script("return rhw.views.pixel.numbers")
        naive = sum(n[w] * n[f"u_{i}"] for i, w in enumerate("rst"))
        right = sum(n[w] * n[f"u_{i}"] for i, w in enumerate("abc"))
        run = {"c": page_programs.run_c, "python": page_programs.run_python, "glsl": page_programs.check_glsl}
        for value, naming, comment in (("c", "A->W", "//"), ("python", "A.W", "#"), ("glsl", "W_of.x", "//")):
            self.node(f"#pixel button[value='{value}']").click()
            rows = self.script("return [...document.querySelectorAll('#pixel .code-line')].map((row) => [...row.children].map((c) => c.textContent))")
            lines = [row for row in rows if len(row) == 2]
            self.assertEqual(len(lines), 10)
            self.assertTrue(any(naming in text for text, _ in lines))
            said = [float(behind.split()[1].replace("−", "-")) for _, behind in lines]
            self.assertTrue(all(behind.startswith(comment) for _, behind in lines))
            self.assertAlmostEqual(said[3], naive, delta=1e-4)
            self.assertAlmostEqual(said[9], right, delta=1e-4)
            gave = run[value]("\n".join(" ".join(row) for row in rows), n)
            if gave:
                self.assertAlmostEqual(gave[0], naive, delta=1e-6)
                self.assertAlmostEqual(gave[1], right, delta=1e-6)
                self.assertAlmostEqual(gave[1], n["u"], delta=1e-6)  # what the page's picture has
        webdriver.ActionChains(self.browser).move_to_element(self.node("#pixel .derivation [data-term='b']")).perform()
        self.assertGreater(self.script("return document.querySelectorAll('#pixel .code-line:has(.alike)').length"), 1)
        webdriver.ActionChains(self.browser).move_to_element(self.node("#pixel .code [data-term='s']")).perform()
        self.wait("document.querySelectorAll('#pixel .derivation .alike').length > 0")

    def test_one_motion(self):
        self.show("motion")
        self.script("document.querySelector('#motion .flight').scrollIntoView({block: 'center'})")
        self.wait("Number(document.querySelector('#motion [name=k]').value) === 1", 15)  # played once
        places = ("return [...document.querySelectorAll('#motion .flight .dot')].map((dot) => [Number(dot.getAttribute('cx')),"
                  " Number(dot.getAttribute('cy'))])")
        rim = "return [...document.querySelector('#motion .flight .screen').points].map(({ x, y }) => [x, y])"
        corners = self.script("return rhw.views.motion.clips")
        (left, bottom), (right, _), (_, top), _ = self.script(rim)
        for (x, y), clip in zip(self.script(places), [clip for clip in corners if clip[3] >= 1]):  # at the end it is the picture
            self.assertAlmostEqual(x, left + (right - left) * (clip[0] / clip[3] + 1) / 2, delta=0.1)
            self.assertAlmostEqual(y, bottom + (top - bottom) * (clip[1] / clip[3] + 1) / 2, delta=0.1)
        self.assertEqual(self.script("""
            const texts = [...document.querySelectorAll('#motion .flight text')], boxes = texts.map((text) => text.getBBox());
            const rim = document.querySelector('#motion .flight .screen').getBBox();
            return [texts.map((text) => text.textContent).filter((name) => /^[A-C]{1,2}$/.test(name)).sort().join(),
                    boxes.some((a, i) => boxes.slice(i + 1).some((b) => a.x < b.x + b.width && b.x < a.x + a.width &&
                                                                        a.y < b.y + b.height && b.y < a.y + a.height)),
                    boxes[texts.findIndex((text) => text.textContent.startsWith('screen'))].y >= rim.y + rim.height - 2]"""),
            ["AB,AC,B,C", False, True], "the corners of the table, whose names can be read, and the screen's below it")
        self.browser.save_screenshot(os.path.join(sys.argv[3], "motion_end.png"))
        slide = "const k = document.querySelector('#motion [name=k]'); k.value = arguments[0]; k.dispatchEvent(new Event('input'))"
        for k in (0, 0.5):
            self.script(slide, k)
            self.browser.save_screenshot(os.path.join(sys.argv[3], f"motion_{k}.png"))
        self.script(slide, 0)
        self.assertNotEqual(self.script("return document.querySelector('#motion .cut-off').getAttribute('points')"), "")
        names = self.script("return [...document.querySelectorAll('#motion .flight text')].map((t) => [t.textContent, t.getAttribute('class')])")
        self.assertTrue(all((kind is None) == (name in ("A", "B", "C")) for name, kind in names), f"after another place of the slider: {names}")
        self.assertIn("−1.527", self.node("#motion table").text)  # Z of A, behind the eye
        width, height = self.script("const { clientWidth: w, clientHeight: h } = document.querySelector('#motion .flight'); return [w, h]")
        for k in (0, 0.1, 0.2, 0.4, 0.6, 0.8, 1):
            self.script(slide, k)
            for x, y in self.script(places):
                self.assertTrue(0 < x < width and 0 < y < height, (k, x, y))  # every corner is in the drawing
            texts = self.script("return [...document.querySelectorAll('#motion .flight text')].map((text) => text.getBBox()).map((b) => [b.x, b.x + b.width])")
            self.assertTrue(all(0 <= left and right <= width for left, right in texts), (k, texts))
        self.size(1024, 900)
        time.sleep(0.2)
        fits = "const room = document.querySelector('#motion .scroll'); return room.scrollWidth <= room.clientWidth"
        self.assertTrue(self.script(fits), "the widest table has room beside the motion")
        self.script(slide, 1)
        distance = "const a = document.querySelector('#motion [name=distance]'); a.value = arguments[0]; a.dispatchEvent(new Event('input'))"
        cells = "return [...document.querySelector('#motion table').rows].map((row) => [...row.cells].map((cell) => cell.textContent))"
        told = self.script(cells)
        for width in (390, 360, 320):
            self.size(width, 844, touch=True)
            for w, corners in ((-0.4, ["AB", "B", "C", "AC", "P"]), (2, ["A", "B", "C", "P"])):
                self.script(distance, w)
                self.wait(f"[...document.querySelectorAll('#motion tr:first-child th')].slice(1).map((cell) => cell.textContent).join() === '{','.join(corners)}'")
                self.assertTrue(self.script(fits), f"and on a phone, where a corner is a column: {width}, {corners}")
                if w == -0.4:
                    self.assertEqual([list(row) for row in zip(*self.script(cells))], told)
        self.script(distance, -0.4)
        self.size(1440, 900)
        for w, hidden in ((-1, "true"), (2, "false")):  # behind the eye a corner has no place in the picture, and comes back
            self.script(distance, w)
            self.wait(f"rhw.views.motion.handles[0].hasAttribute('hidden') === {hidden}")

    def test_a_picture_that_nobody_has_seen_has_its_numbers(self):
        self.open("#exercises")
        self.wait("window.rhw?.views.motion && document.querySelector('#motion table').textContent")
        self.assertEqual(self.script("return [rhw.views.motion.canvas.width, rhw.views.motion.figure.dataset.drawn ?? '']"), [64, ""])

    def test_no_line_begins_with_the_sign_behind_a_formula(self):
        loose = ("return [...document.querySelectorAll('rhw-math')].filter((math) => !math.closest('.equation') &&"
                 " /^[.,;:)，。；：、）]/u.test(math.nextSibling?.data ?? '')).map((math) => math.parentElement.textContent)")
        self.assertEqual(self.script(loose), [])
        self.assertGreater(self.script("return document.querySelectorAll('.equation > rhw-math').length"), 4)
        broken = ("const found = []; for (const text of document.querySelectorAll('p[lang]')) { const words = text.cloneNode(true);"
                  " words.querySelectorAll('.equation, rhw-math').forEach((node) => node.remove());"
                  " found.push(...(words.textContent.match(/\\w = \\S+/g) ?? [])); } return found")
        self.assertEqual(self.script(broken), [], "an equation stays on its line")

    def test_curves_of_depth_have_scales(self):
        self.show("depth")
        ends = ("return [...document.querySelectorAll('#depth .plot .curve')].map(({ points }) => Math.min(...[...points].map(({ y }) => y)))")
        said = [float(word) for word in re.findall(r"0 to ([0-9.]+)", self.node("#depth .legend").text)]
        self.assertEqual(len(said), 4)
        self.assertEqual(said[2], said[3], "those of W share theirs")
        n = self.script("return rhw.views.depth.numbers")
        tops, floor, here = self.script(ends), *self.script(
            "const line = document.querySelector('#depth .plot .here'); return [Number(line.getAttribute('y2')), Number(line.getAttribute('x1'))]")
        full = floor - min(tops)
        for i, value in enumerate((n["depth"], n["inverse_w"], 1 / n["inverse_w"])):
            y = self.script("const points = [...document.querySelectorAll('#depth .plot .curve')[arguments[0]].points];"
                            "return points.reduce((a, b) => Math.abs(a.x - arguments[1]) < Math.abs(b.x - arguments[1]) ? a : b).y", i, here)
            self.assertAlmostEqual((floor - y) / full * said[i], value, delta=0.03 * value)

    def test_exercises_are_checked(self):
        self.show("exercises")
        done = lambda: self.script("return [...document.querySelectorAll('#exercises li')].map((li) => li.classList.contains('done'))")  # noqa: E731
        self.assertEqual(done(), [False] * 6)
        self.script("document.querySelector('#exercises').dispatchEvent(new Event('pointermove'))")

        def point(pixel):
            if pixel:
                self.script("rhw.views.exercises.pick(arguments[0])", pixel)
            time.sleep(0.8)  # what does not rest is not looked at

        def put(corners, pixel=None):
            self.script("const v = rhw.views.exercises; arguments[0].forEach((at, i) => (v.scene.corners[i].at = at));"
                        "v.pixel = null; v.figure.dataset.drawn = ''; v.update()", corners)
            self.wait("rhw.views.exercises.figure.dataset.drawn === 'still'")
            point(pixel)

        def seen(at):
            x, y, _, w = self.script("return rhw.views.exercises.stageClip(arguments[0])", at)
            return [(x / w + 1) / 2, (1 - y / w) / 2]
        a, b, c = [-1.3, -0.7, 0.4], [1.4, -0.6, -2.6], [0.1, 1.1, -0.6]
        put([a, b, c], seen([0.05, -0.645, -1.1]))  # the middle of AB, a little inside
        self.assertTrue(done()[2])
        self.assertFalse(any(done()[i] for i in (0, 3, 4, 5)))
        put([a, [1.4, -0.7, 0.4], [0.1, 1.1, -1.5]])
        self.assertTrue(done()[4])
        put([[-1.3, -0.7, 0], [1.4, -0.7, 0], [0.1, 1.1, 0]])
        self.assertTrue(done()[0])
        self.assertFalse(done()[5])
        put([a, b, c])
        errors = self.script("""
            const v = rhw.views.exercises, found = [];
            for (let y = 0.05; y < 1; y += 0.02) for (let x = 0.05; x < 1; x += 0.02) {
              v.pixel = [x, y]; v.explain();
              const n = v.numbers;
              if (n) found.push([x, y, Math.abs(n.r * n.u_0 + n.s * n.u_1 + n.t * n.u_2 - n.a * n.u_0 - n.b * n.u_1 - n.c * n.u_2),
                                Math.min(n.r, n.s, n.t) > 0.05 && Math.abs(n.t - n.c) < 0.005]);
            }
            return found""")
        self.assertFalse(done()[3], "whoever passes over a place has not pointed at it")
        worst = max(errors, key=lambda error: error[2])
        self.assertGreater(worst[2], 0.05)
        point(worst[:2])
        self.assertTrue(done()[1])
        point(next(error[:2] for error in errors if error[3]))
        self.assertTrue(done()[3])
        put([a, b, [0.1, 0.4, 3.6]])
        point(self.script("const v = rhw.views.exercises; for (let y = 0.05; y < 1; y += 0.05) {"
                          " v.pixel = [0.5, y]; v.explain(); if (v.numbers) return v.pixel; }"))
        self.assertTrue(done()[5], self.script("return rhw.views.exercises.numbers"))
        asked = ("const [n, ws] = arguments; return import('./chapters/exercises.js')"
                 ".then(({ EXERCISES }) => EXERCISES[1].met(n, { ws, worst: () => 1 }))")
        wrong = {"r": 1, "s": 0, "t": 0, "u_0": 1, "u_1": 0, "u_2": 0, "u": 0}
        for ws, met in (([1, 2, 3], True), ([1, 2, -3], False)):  # √W, which its answer is about, is a number
            self.assertIs(self.script(asked, wrong, ws), met)
        self.assertIn("✓", self.node("#exercises li:last-child .result").text)
        self.node("#exercises li:last-child button").click()
        self.wait("!document.querySelector('#exercises li:last-child').classList.contains('done')")

    # By the number of an exercise, what P has to be to solve it, well within what is asked.
    SOLVED_BY = {
        1: "error(n) > 0.95 * Math.max(...all.map(({ n: one }) => error(one)))",
        2: "Math.abs(n.a - 0.5) < 0.03 && Math.abs(n.b - 0.5) < 0.03",
        3: "Math.min(n.r, n.s, n.t) > 0.08 && Math.abs(n.t - n.c) < 0.006",
        5: "true",
    }

    def place_for(self, exercise):
        """A pixel of the picture, by parts of it, that solves an exercise; P stays where it is."""
        return self.script(f"""
            const v = rhw.views.exercises, kept = v.pixel, all = [];
            const error = (n) => Math.abs((n.r - n.a) * n.u_0 + (n.s - n.b) * n.u_1 + (n.t - n.c) * n.u_2);
            for (let y = 0.02; y < 1; y += 0.01) for (let x = 0.02; x < 1; x += 0.01) {{
              v.pixel = [x, y]; v.explain();
              if (v.numbers) all.push({{ at: [x, y], n: v.numbers }});
            }}
            v.pixel = kept; v.numbers = null;
            return all.find(({{ n }}) => {self.SOLVED_BY[exercise]}).at""")

    def wait_solved(self, exercise):
        self.wait(f"document.querySelectorAll('#exercises li')[{exercise}].classList.contains('done')")

    def test_exercises_by_keys(self):
        """All six: P goes there by arrows in the picture; corners that the tab key comes to, by page up and down."""
        self.show("exercises")
        canvas = self.node("#exercises .view canvas")
        self.script("arguments[0].focus()", canvas)

        def go(exercise):
            at = self.place_for(exercise)
            self.script("rhw.views.exercises.pick(rhw.views.exercises.pixel ?? [0.5, 0.5])")
            by = self.script("const v = rhw.views.exercises; return [v.canvas.width, v.canvas.height].map((size, i) =>"
                             " Math.floor(arguments[0][i] * size) - Math.floor(v.pixel[i] * size))", at)
            keys = [(Keys.ARROW_LEFT, Keys.ARROW_RIGHT), (Keys.ARROW_UP, Keys.ARROW_DOWN)]
            for count, pair in zip(by, keys):
                tens, ones = divmod(abs(count), 10)
                canvas.send_keys(pair[count > 0] * ones, Keys.SHIFT, pair[count > 0] * tens)
            self.wait_solved(exercise)

        def push(name, presses):
            self.script("arguments[0].focus()", canvas)
            for _ in range(6):
                self.browser.switch_to.active_element.send_keys(Keys.TAB)
                if f"corner{name}" in (self.browser.switch_to.active_element.get_attribute("class") or ""):
                    break
            self.browser.switch_to.active_element.send_keys(Keys.SHIFT, Keys.PAGE_DOWN * presses)
        for exercise in (1, 2, 3):
            go(exercise)
        push("B", 3)
        self.wait_solved(4)
        push("C", 1)
        self.wait_solved(0)
        push("C", 3)
        self.still("exercises")
        go(5)

    def test_exercises_under_a_finger(self):
        """All six on a phone: it points in the picture, and moves corners in the view from above."""
        self.size(390, 844, touch=True)
        try:
            self.setUp()
            self.show("exercises")
            self.script("document.querySelector('#exercises .above').scrollIntoView({block: 'center'})")

            def tap(exercise):
                box = self.script("const b = document.querySelector('#exercises .view canvas').getBoundingClientRect();"
                                  "return [b.x, b.y, b.width, b.height]")
                x, y = (round(box[i] + at * box[i + 2]) for i, at in enumerate(self.place_for(exercise)))
                for kind, points in (("touchStart", [{"x": x, "y": y}]), ("touchEnd", [])):
                    self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
                self.wait_solved(exercise)
            for exercise in (1, 2, 3):
                tap(exercise)
            place = lambda node: self.middle(f"#exercises .top {node}")[1]  # noqa: E731
            for name, solved in (("B", 4), ("C", 0)):
                self.swipe(f"#exercises .top .corner{name} .dot", place(".cornerA .dot") - place(f".corner{name} .dot"))
                self.wait_solved(solved)
            self.swipe("#exercises .top .cornerC .dot", place(".eye") + 15 - place(".cornerC .dot"))
            self.still("exercises")
            tap(5)
            self.script("document.querySelector('#exercises li').scrollIntoView({block: 'end'})")
            self.assertTrue(self.node("#exercises .result").is_displayed())
            self.assertLessEqual(self.script("return document.documentElement.scrollWidth"), 390)
            self.browser.save_screenshot(os.path.join(sys.argv[3], "phone_exercises_solved.png"))
        finally:
            self.size(1440, 900)

    def test_the_address_is_the_state(self):
        self.drag("#pixel .view .cornerA .dot", 40, -30)
        self.node("#pixel button[value='glsl']").click()
        self.wait("location.hash.includes('code=glsl') && location.hash.startsWith('#pixel?')")
        self.still()
        corner, pixel, address = self.corner(0), self.script("return rhw.views.pixel.pixel"), self.script("return location.hash")
        self.assertIn("lang=en", address)
        self.open(address.replace("lang=en", "lang=zh").replace("theme=light", "theme=dark"))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        for value, kept in zip(self.corner(0) + self.script("return rhw.views.pixel.pixel"), corner + pixel):
            self.assertAlmostEqual(value, kept, delta=1e-4)
        self.assertEqual(self.script("return [document.documentElement.lang, document.documentElement.dataset.theme]"), ["zh", "dark"])
        self.assertEqual(self.node("#pixel [data-name='code'] [aria-pressed='true']").text, "GLSL")
        self.assertLess(abs(self.script("return document.getElementById('pixel').getBoundingClientRect().top") - 56), 10)
        self.node("#language").click()
        self.node("#theme").click()
        self.open(self.script("return location.hash"))
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        self.assertEqual(self.script("return [document.documentElement.lang, document.documentElement.dataset.theme]"), ["en", "light"])
        self.assertAlmostEqual(self.corner(0)[0], corner[0], delta=1e-4)
        self.open("#floor")
        self.wait("window.rhw?.views.floor?.figure.dataset.drawn === 'still'")
        self.script("rhw.views.floor.scene.turn(100, -60); rhw.views.floor.pick([0.5, 0.6])")
        eye, saved = self.script("const v = rhw.views.floor; return [v.scene.camera.eye, Object.entries(v.save())]")
        self.open(f"#floor?{'&'.join('='.join(pair) for pair in saved)}")
        self.wait("window.rhw?.views.floor?.figure.dataset.drawn === 'still'")
        for value, kept in zip(self.script("return rhw.views.floor.scene.camera.eye"), eye):
            self.assertAlmostEqual(value, kept, delta=1e-4)
        self.open("#weights?P=NaN,7&A=1,2&B=1e99,-1e99,Infinity&lang=xx&theme=%22")  # nothing of it is a place
        self.wait("window.rhw?.views.weights?.figure.dataset.drawn === 'still'")
        self.assertIn(self.script("return document.documentElement.lang"), ["en", "zh"])
        self.open("#floor?method=world&P=0.5,0.6")
        self.wait("window.rhw?.views.floor?.numbers?.method === 2")
        self.script("location.hash = '#floor?method=correct'")
        self.wait("rhw.views.floor.numbers.method === 1")
        self.open("#pixel?A=,,&B=1e200,0,-5")
        self.wait("window.rhw?.views.pixel?.figure.dataset.drawn === 'still'")
        self.assertNotEqual(self.corner(0), [0, 0, 0], "what an address leaves out is no 0")
        self.open("#motion?k=0.5&P=0.5,0.5")
        self.wait("window.rhw?.views.motion?.figure")
        time.sleep(1)
        self.assertEqual(self.script("return document.querySelector('#motion [name=k]').valueAsNumber"), 0.5, "the motion stays where it is shown")
        for chapter in ("inverse", "model"):  # which draw nothing that the others could wait for
            self.open(f"#{chapter}")
            self.wait("Object.keys(window.rhw?.views ?? {}).length > 8")

    def test_a_taken_triangle_by_its_address(self):
        """One of another picture, far beyond what may be dragged here, is the same when its address is opened."""
        self.show("weights")
        self.script("const v = rhw.views.weights, clips = [0, 1, 2].map((i) => ['X', 'Y', 'Z', 'W'].map((axis) => 100 * v.numbers[`${axis}_${i}`]));"
                    "v.take({ clips, space: [v.numbers.a, v.numbers.b, v.numbers.c] })")
        self.wait("rhw.views.weights.numbers?.W_0 > 100")
        n, saved = self.script("return [rhw.views.weights.numbers, Object.entries(rhw.views.weights.save())]")
        self.open(f"#weights?{'&'.join('='.join(pair) for pair in saved)}")
        self.wait(f"Math.abs(window.rhw?.views.weights?.numbers?.W_0 / {n['W_0']} - 1) < 1e-4"
                  " && rhw.views.weights.figure.dataset.drawn === 'still'")
        again = self.script("return rhw.views.weights.numbers")
        for name in "rstabc":
            self.assertAlmostEqual(again[name], n[name], delta=0.002)
        self.script("location.hash = '#weights?A=0.1,0.2,-2'")  # of the chapter's own triangle
        self.wait("!rhw.views.weights.scene.taken && rhw.views.weights.scene.corners[0].at[2] === -2")

    def test_contents_and_notes(self):
        self.node(".contents summary").click()
        items = self.browser.find_elements(By.CSS_SELECTOR, ".contents li a[lang='en']")
        self.assertEqual(len(items), len(self.browser.find_elements(By.CSS_SELECTOR, "section.chapter")))
        [item for item in items if "Depth" in item.text][0].click()
        self.wait("Math.abs(document.getElementById('depth').getBoundingClientRect().top - 56) < 10")
        self.assertTrue(self.node("#depth .notes p").is_displayed())
        self.node("#notes").click()
        self.assertFalse(self.node("#depth .notes p").is_displayed())
        self.open("#depth")
        self.wait("window.rhw?.views.depth?.figure.dataset.drawn === 'still'")
        self.assertFalse(self.node("#depth .notes p").is_displayed(), "it is remembered")
        self.wait("rhw.views.model")
        self.script("for (const view of Object.values(rhw.views)) { if (view?.figure) delete view.figure.dataset.drawn; }"
                    "dispatchEvent(new Event('beforeprint'))")
        missing = self.script("return [...document.querySelectorAll('.view:not(.drop)')].filter((figure) => !figure.dataset.drawn)"
                              ".map((figure) => figure.closest('section').id)")
        self.assertEqual(missing, [], "paper has every picture")
        self.assertTrue(self.node("#first .after").is_displayed() and self.node("#depth .notes p").is_displayed())
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        self.assertFalse(self.node("header").is_displayed())
        self.assertEqual(len([1 for step in self.browser.find_elements(By.CSS_SELECTOR, ".steps > li") if step.is_displayed()]), 4)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.script("dispatchEvent(new Event('afterprint'))")
        self.assertFalse(self.node("#first .after").is_displayed(), "and the question is asked again")
        self.node("#notes").click()

    def test_whoever_wants_colours_of_their_own(self):
        color = ("return arguments[0].map((part) => document.querySelector(part)).map((node, i) =>"
                 " getComputedStyle(node, i === 2 ? '::before' : null).backgroundColor)")
        parts = ["#weights .bar b", "#pixel [aria-pressed='true']", "#inverse .key", "#pixel [aria-pressed='false']"]
        own = self.script(color, parts)
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "forced-colors", "value": "active"}]})
        try:
            forced = self.script(color, parts)
            self.assertEqual([forced[0], forced[2]], [own[0], own[2]], "bars and names of curves keep the colours that they are known by")
            self.assertNotEqual(forced[1], forced[3], "what is chosen is seen")
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_whoever_wants_no_motion(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        try:
            self.open("#motion")
            self.wait("window.rhw?.views.motion?.figure.dataset.drawn === 'still'")
            self.script("document.querySelector('#motion .flight').scrollIntoView({block: 'center'})")
            time.sleep(0.5)
            self.assertEqual(self.script("return document.querySelector('#motion [name=k]').value"), "0")
        finally:
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
