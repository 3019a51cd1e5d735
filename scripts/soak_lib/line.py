"""A line between a client and the master that can be slowed and cut."""
import contextlib
import socket
import threading
import time

PIECE = 1 << 14  # bytes


class Line:
    """Passes on what comes to `address`, both ways, to any number of connections one after another."""

    def __init__(self, port):
        self.pause = 0.0  # seconds for each piece
        self.target = ("127.0.0.1", port)
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self.listener.getsockname()[1]}"
        self.open = set()
        self.lock = threading.Lock()
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self):
        with contextlib.suppress(OSError):  # closed
            while True:
                near, _ = self.listener.accept()
                try:
                    far = socket.create_connection(self.target, 5)
                except OSError:
                    near.close()  # no master now
                    continue
                far.settimeout(None)
                with self.lock:
                    self.open |= {near, far}
                for source, sink in (near, far), (far, near):
                    threading.Thread(target=self._pump, args=(source, sink), daemon=True).start()

    def _pump(self, source, sink):
        with contextlib.suppress(OSError):  # the other side is gone
            while piece := source.recv(PIECE):
                time.sleep(self.pause)
                sink.sendall(piece)
        self._end(source, sink)

    def _end(self, *ends):
        for end in ends:
            with self.lock:
                self.open.discard(end)
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def cut(self):
        with self.lock:
            ends = list(self.open)
        self._end(*ends)

    def close(self):
        self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()
        self.cut()
