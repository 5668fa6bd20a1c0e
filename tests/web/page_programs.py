# SPDX-License-Identifier: MIT
"""The programs that the page shows, run with the numbers of a pixel as the page's stage tells them: [naive, corrected], or None."""
import os
import subprocess
import tempfile
import types

INCLUDE = os.path.join(os.path.dirname(__file__), "..", "..", "include")

# The fragment function, called once as the pipeline calls it: with the shares of the fragment, and the corners as its uniforms.
MAIN = """
#include <stdio.h>

int main(void)
{
    const struct corner corners[3] = {%s};
    float color[1][4] = {{0}};
    struct rhw_fragment1 fragment = {.uniforms = corners, .color = color, .barycentric_noperspective = {%s}};
    paint1(&fragment);
    printf("%%.9g %%.9g\\n", (double)color[0][0], (double)color[0][1]);
    return 0;
}
"""


def run_c(text, n):
    corners = ", ".join(f"{{(float){float(n[f'W_{i}'])!r}, (float){float(n[f'u_{i}'])!r}}}" for i in range(3))
    shares = ", ".join(f"(float){float(n[name])!r}" for name in "rst")
    with tempfile.TemporaryDirectory() as folder:
        source, program = os.path.join(folder, "paint.c"), os.path.join(folder, "paint")
        with open(source, "w") as file:
            file.write(text + MAIN % (corners, shares))
        subprocess.run([os.environ.get("CC", "cc"), "-std=c17", "-O1", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", "-I", INCLUDE,
                        source, "-o", program], check=True)
        return [float(word) for word in subprocess.run([program], check=True, capture_output=True, text=True).stdout.split()]


def run_python(text, n):
    program = {}
    exec(text, program)
    corners = [types.SimpleNamespace(W=n[f"W_{i}"], u=n[f"u_{i}"]) for i in range(3)]
    return program["paint"](*corners, *(n[f"e_{i}"] for i in range(3)))


def check_glsl(text, _):
    """A shader runs where there is a window; that it is one, its compiler says."""
    with tempfile.NamedTemporaryFile("w", suffix=".frag") as file:
        file.write(text)
        file.flush()
        subprocess.run(["glslangValidator", file.name], check=True, stdout=subprocess.DEVNULL)
    return None
