"""serve.py: a server of files for tests, which misbehaves as it is told. Kinds, by the first folder of a path: `parts` gives ranges, `whole`
gives all of a file whatever is asked, `moved` redirects to `parts`, `ring` to itself, `changes` has another version at each answer, `gone`
hangs up in the middle of what is not at the file's begin, `busy` fails once before each answer, `shut` forbids, `slow` takes a fifth of a second
for each."""

import http.server
import pathlib
import re
import ssl
import threading
import time

RANGE = re.compile(r"^bytes=(\d+)-(\d+)$")


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        server = self.server
        with server.lock:
            server.waiting += 1
            server.most_waiting = max(server.most_waiting, server.waiting)
        try:
            self.respond(server)
        finally:
            with server.lock:
                server.waiting -= 1

    def respond(self, server):
        kind, _, name = self.path.split("?")[0].lstrip("/").partition("/")
        file = server.folder / name
        asked = RANGE.match(self.headers.get("Range", ""))
        server.asked.append((kind, name, asked and (int(asked[1]), int(asked[2]))))
        if kind == "slow":
            time.sleep(0.2)
        if kind == "shut":
            self.answer(403)
        elif kind == "moved":
            self.answer(302, Location=f"/parts/{name}")
        elif kind == "ring":
            self.answer(302, Location=self.path)
        elif kind == "busy" and len(server.asked) % 2 == 1:
            self.answer(503)
        elif not file.is_file():
            self.answer(404)
        else:
            self.give(kind, file.read_bytes(), asked)

    def give(self, kind, data, asked):
        version = f'"{len(self.server.asked) if kind == "changes" else 1}"'
        if kind == "whole" or asked is None:
            return self.answer(200, data, ETag=version)
        first, last = int(asked[1]), min(int(asked[2]), len(data) - 1)
        if first >= len(data):
            return self.answer(416, Content_Range=f"bytes */{len(data)}")
        part = data[first:last + 1]
        self.send_response(206)
        self.send_header("Content-Range", f"bytes {first}-{last}/{len(data)}")
        self.send_header("ETag", version)
        self.send_header("Content-Length", str(len(part)))
        self.end_headers()
        self.wfile.write(part[:len(part) // 2] if kind == "gone" and first > 0 else part)
        self.close_connection = kind == "gone"


class Server(http.server.ThreadingHTTPServer):
    """Serves a folder on a free port of this machine, by TLS where a certificate's and a key's file are given."""

    daemon_threads = True

    def __init__(self, folder, certificate=None, key=None):
        super().__init__(("127.0.0.1", 0), Handler)
        self.folder, self.asked = pathlib.Path(folder), []
        self.lock, self.waiting, self.most_waiting = threading.Lock(), 0, 0  # requests without an answer
        if certificate:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate, key)
            self.socket = context.wrap_socket(self.socket, server_side=True)
        self.url = f"{'https' if certificate else 'http'}://localhost:{self.server_port}"
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def handle_error(self, *_):
        """Clients that hang up, as they do where they are not given what they want, are no news."""
