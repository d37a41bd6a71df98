"""A TCP proxy that writes what passes into a capture file, which needs no privilege.

Each piece that it receives becomes a packet with the IP and TCP headers that belong to it.
"""

import socket
import struct
import threading
import time

CLIENT, SERVER = "192.0.2.1", "192.0.2.2"  # addresses for documentation
SERVER_PORT = 502

RAW_IP = 101  # link type of the capture file
SYN, ACK, PUSH, FIN = 2, 16, 8, 1


class Capture:
    """A file in pcap format."""

    def __init__(self, path):
        self._file = open(path, "wb")
        self._file.write(struct.pack("=IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 65535, RAW_IP))
        self._lock = threading.Lock()

    def add(self, packet):
        """Adds an IP packet with the present time."""
        with self._lock:
            now_us = time.time_ns() // 1000
            self._file.write(struct.pack("=IIII", now_us // 1000000, now_us % 1000000,
                                         len(packet), len(packet)))
            self._file.write(packet)

    def close(self):
        """Ends the file."""
        self._file.close()


class Conversation:
    """The packets of one TCP connection. Checksums are left out."""

    def __init__(self, capture, client_port):
        self._capture = capture
        self._client_port = client_port
        self._sent = {True: 0, False: 0}  # next sequence number, by whether of the client
        self._lock = threading.Lock()
        self.add(True, SYN)
        self.add(False, SYN | ACK)
        self.add(True, ACK)

    def add(self, is_client, flags, data=b""):
        """Adds a packet of one of the two."""
        with self._lock:
            places = [(CLIENT, self._client_port), (SERVER, SERVER_PORT)]
            (source, source_port), (target, target_port) = places if is_client else places[::-1]
            tcp = struct.pack(">HHIIBBHHH", source_port, target_port, self._sent[is_client],
                              self._sent[not is_client], 5 << 4, flags, 65535, 0, 0)
            header = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(tcp) + len(data), 0, 0, 64,
                                 socket.IPPROTO_TCP, 0, socket.inet_aton(source),
                                 socket.inet_aton(target))
            self._capture.add(header + tcp + data)
            self._sent[is_client] += len(data) + (1 if flags & (SYN | FIN) else 0)


class RecordingProxy:
    """Stands between clients and a server, until its context is left."""

    def __init__(self, place, capture):
        host, port = place.split(":")
        self._target = (host, int(port))
        self._capture = capture
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._threads = [threading.Thread(target=self._accept)]

    @property
    def place(self):
        """Where clients connect to."""
        host, port = self._listener.getsockname()
        return f"{host}:{port}"

    def _accept(self):
        while True:
            try:
                client, address = self._listener.accept()
            except OSError:  # the end
                return
            server = socket.create_connection(self._target)
            conversation = Conversation(self._capture, address[1])
            for is_client, source, target in ((True, client, server), (False, server, client)):
                thread = threading.Thread(target=self._pass_on,
                                          args=(conversation, is_client, source, target))
                self._threads.append(thread)
                thread.start()

    @staticmethod
    def _pass_on(conversation, is_client, source, target):
        while data := source.recv(65536):
            conversation.add(is_client, ACK | PUSH, data)
            target.sendall(data)
        conversation.add(is_client, ACK | FIN)
        target.shutdown(socket.SHUT_WR)

    def __enter__(self):
        self._threads[0].start()
        return self

    def __exit__(self, exception_type, exception, traceback):
        self._listener.shutdown(socket.SHUT_RDWR)
        for thread in self._threads:
            thread.join()
        self._listener.close()
