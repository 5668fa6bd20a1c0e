#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes one file of the page that opens by double click: its modules bundled by esbuild, its style and everything that it would
fetch within it.

usage: single.py PAGE-FOLDER FILE
"""
import base64
import gzip
import html
import re
import subprocess
import sys
from pathlib import Path

FETCHED = ["stage.wasm", "models/box.glb"]  # by the page itself
WORKER = "model_worker.js"
WORKER_FETCHED = ["rhw.wasm"]
# Only pages that share memory have threads, and a page of a file shares none.
NEVER = ["./stage-threads.js", "./rhw-threads.js"]

# What stands before the page's program and the worker's. Addresses that a module would have relative to itself are below a base
# that is nowhere, and what is asked for there is taken from what came along.
BEFORE = """
const rhwBase = 'https://in-this-file.invalid/';
const rhwNameOf = (url) => String(url).replace(rhwBase, '').replace(/^\\.\\//, '');
const rhwOutside = globalThis.fetch;
globalThis.fetch = (url, ...rest) => {
  const text = rhwFiles(rhwNameOf(url));
  if (text === undefined) {
    return rhwOutside(url, ...rest);
  }
  const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const bytes = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return Promise.resolve(new Response(bytes, { headers: { 'content-type': 'application/wasm' } }));
};
"""
# The page's files are elements of it; the worker's are written into its text when it begins.
PAGE_FILES = """
const rhwElement = (name) => document.querySelector(`script[data-file="${CSS.escape(name)}"]`);
const rhwFiles = (name) => rhwElement(name)?.textContent;
const RhwWorker = globalThis.Worker;
globalThis.Worker = class extends RhwWorker {
  constructor(url) {
    const files = Object.fromEntries(WORKER_FETCHED.map((name) => [name, rhwFiles(name)]));
    const text = `const rhwFiles = (name) => (${JSON.stringify(files)})[name];${rhwElement('WORKER').textContent}`;
    super(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
  }
};
"""


def bundle(entry):
    told = subprocess.run(["esbuild", entry, "--bundle", "--format=iife", "--target=es2022", "--charset=utf8", "--log-level=error",
                           "--define:import.meta.url=rhwBase", *(f"--external:{name}" for name in NEVER)],
                          check=True, stdout=subprocess.PIPE, text=True)
    return told.stdout.replace("</script", "<\\/script")


def element(name, text, kind):
    return f'<script type="{kind}" data-file="{name}">{text}</script>\n'


def packed(path):
    return base64.b64encode(gzip.compress(path.read_bytes(), 9, mtime=0)).decode()


def licenses(folder):
    """Those of the libraries within, to be read at the end of the page."""
    texts = [f"{path.name}\n\n{path.read_text(encoding='utf-8')}" for path in sorted((folder / "rhw" / "licenses").iterdir())]
    text = html.escape("\n\n".join(texts))
    return f'<details class="licenses"><summary>licenses</summary><pre>{text}</pre></details>\n'


def page_of(folder):
    files = [element(name, packed(folder / name), "text/plain") for name in FETCHED]
    files += [element(name, packed(folder / "rhw" / name), "text/plain") for name in WORKER_FETCHED]
    files.append(element(WORKER, BEFORE + bundle(folder / WORKER), "text/plain"))
    page_files = PAGE_FILES.replace("WORKER_FETCHED", str(WORKER_FETCHED)).replace("'WORKER'", f"'{WORKER}'")
    program = f"<script>\n(() => {{{page_files}{BEFORE}{bundle(folder / 'main.js')}}})();\n</script>\n"
    page = (folder / "index.html").read_text(encoding="utf-8")
    page = re.sub(r'<link rel="(?:preload|modulepreload)"[^>]*>\n|<script[^>]*></script>\n', "", page)
    style = f"<style>\n{(folder / 'page.css').read_text(encoding='utf-8')}</style>\n"
    page = page.replace('<link rel="stylesheet" href="page.css">\n', style)
    page = page.replace("</footer>", f"{licenses(folder)}</footer>")
    return page.replace("</body>", "".join(files) + program + "</body>")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    page = page_of(Path(sys.argv[1]))
    Path(sys.argv[2]).write_text(page, encoding="utf-8")
    print(f"{sys.argv[2]}: {len(page.encode())} bytes")


if __name__ == "__main__":
    main()
