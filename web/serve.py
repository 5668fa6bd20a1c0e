#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Serves a folder on localhost, cross-origin isolated, so that WebAssembly may use threads.

usage: serve.py FOLDER [PORT]
"""
import functools
import http.server
import sys


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".js": "text/javascript"}

    isolated = True

    def end_headers(self):
        if self.isolated:
            self.send_header("Cross-Origin-Opener-Policy", "same-origin")
            self.send_header("Cross-Origin-Embedder-Policy", "require-corp")
        self.send_header("Cache-Control", "no-cache")
        super().end_headers()

    def log_message(self, *_):
        pass


class PlainHandler(Handler):
    """As most hosts of static files are."""

    isolated = False


def make_server(folder, port=0, isolated=True):
    """A server of `folder`; port 0: one that is free."""
    handler = Handler if isolated else PlainHandler
    return http.server.ThreadingHTTPServer(("127.0.0.1", port), functools.partial(handler, directory=folder))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    try:
        server = make_server(sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 8000)
    except OSError as error:
        sys.exit(f"serve.py: port {sys.argv[2] if len(sys.argv) == 3 else 8000}: {error.strerror}")
    print(f"http://localhost:{server.server_port}/ (Ctrl+C ends it)", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass
