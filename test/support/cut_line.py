"""A TCP line to a server of this host that can be cut: both ends stay open, and nothing passes. Standard library only."""
import select
import socket
import threading


class CutLine:
    def __init__(self, port):
        self.to = port
        self.passes = threading.Event()
        self.passes.set()
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self):
        self.passes.clear()

    def mend(self):
        self.passes.set()

    def _accept(self):
        while True:
            near, _ = self.listener.accept()
            far = socket.create_connection(("127.0.0.1", self.to))
            threading.Thread(target=self._carry, args=(near, far), daemon=True).start()

    def _carry(self, near, far):
        try:
            while True:
                for end in select.select([near, far], [], [], 0.05)[0]:
                    self.passes.wait()
                    data = end.recv(65536)
                    if not data:
                        return
                    (far if end is near else near).sendall(data)
        except OSError:
            pass
        finally:
            near.close()
            far.close()
