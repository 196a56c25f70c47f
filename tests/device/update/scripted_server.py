"""An HTTP/1.1 server of a folder on 127.0.0.1, with ranges, whose answers a test may replace."""

import re
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from socketserver import TCPServer


class ScriptedServer:
    """`requests`: path and range of each; `instead` is called with each handler first, and returns True if it has answered."""

    def __init__(self, folder, tls=None):
        self.folder, self.requests, self.sent_bytes = folder, [], 0
        self.instead = lambda _: False
        self.ranges = True
        self.ended = threading.Event()
        self._http = _Server(("127.0.0.1", 0), _Handler)
        self._http.scripted = self
        if tls:
            self._http.socket = tls.wrap_socket(self._http.socket, server_side=True)
        self.address = f"http{'s' if tls else ''}://127.0.0.1:{self._http.server_port}"
        self._thread = threading.Thread(target=self._http.serve_forever, args=(0.01,))
        self._thread.start()

    def stop(self):
        if not self.ended.is_set():
            self.ended.set()
            self._http.shutdown()
            self._thread.join()
            self._http.server_close()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def server_bind(self):  # without asking a name server for the host's name
        TCPServer.server_bind(self)
        self.server_name, self.server_port = self.server_address

    def handle_error(self, request, client_address):  # a client that goes away is no news
        pass


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True

    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        for name, value in ({"Content_Length": len(body), "Content_Type": "application/octet-stream"} | headers).items():
            if value is not None:
                self.send_header(name.replace("_", "-"), str(value))
        self.end_headers()
        self.server.scripted.sent_bytes += len(body)
        self.wfile.write(body)

    def do_GET(self):
        scripted = self.server.scripted
        scripted.requests.append((self.path, self.headers.get("Range")))
        if scripted.instead(self):
            return
        file = scripted.folder / self.path.lstrip("/")
        if not file.is_file():
            self.answer(404, b"not here")
            return
        data = file.read_bytes()
        wanted = re.fullmatch(r"bytes=(\d+)-(\d*)", self.headers.get("Range") or "")
        if wanted and scripted.ranges:
            start, stop = int(wanted[1]), min(int(wanted[2] or len(data)) + bool(wanted[2]), len(data))
            if start >= len(data):
                self.answer(416, Content_Range=f"bytes */{len(data)}")
                return
            self.answer(206, data[start:stop], Content_Range=f"bytes {start}-{stop - 1}/{len(data)}")
        else:
            self.answer(200, data)
