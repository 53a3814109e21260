# SPDX-License-Identifier: Apache-2.0
"""A ROS master in between, that notes which parameters a process asks for."""
import socketserver
import threading
import xmlrpc.client
import xmlrpc.server

import rosgraph

ASKING = ("getParam", "hasParam", "subscribeParam", "searchParam")


class _Server(socketserver.ThreadingMixIn, xmlrpc.server.SimpleXMLRPCServer):
    daemon_threads = True


class ParameterSpy:
    """Passes all calls on to the real master.

        with ParameterSpy() as spy:
            with Component("/nowhere", {...}, {"ROS_MASTER_URI": spy.uri}):
                ...
            spy.asked_below("/nowhere")
    """

    def __init__(self):
        self._asked = set()
        self._lock = threading.Lock()
        self._server = _Server(("localhost", 0), logRequests=False, allow_none=True)
        self._server.register_instance(self)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self.uri = "http://localhost:%d" % self._server.server_address[1]

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()

    def _dispatch(self, method, arguments):
        if method in ASKING:
            with self._lock:
                self._asked.add(arguments[1])
        with xmlrpc.client.ServerProxy(rosgraph.get_master_uri(), allow_none=True) as master:
            return getattr(master, method)(*arguments)

    def asked_below(self, namespace):
        """Full names."""
        start = namespace.rstrip("/") + "/"
        with self._lock:
            return {name for name in self._asked if name.startswith(start)}
