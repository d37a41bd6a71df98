#!/usr/bin/env python3
"""Lets Modbus clients work with `gonio serve` and asks tshark for malformed packets.

    check_packets.py GONIO INSTRUMENT

What the clients and the server say passes through a proxy that records it, so that no privilege to
capture packets is needed. That tshark would notice is made sure of with packets that are malformed.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from gonio_server import GonioServer, measured_gloss
from recording_proxy import ACK, PUSH, Capture, Conversation, RecordingProxy, SERVER_PORT
from run_client import LINES, OPTIONS, SAMPLE, client_command

CLIENTS = ["pymodbus", "modbus_serial", "jsmodbus"]
FUNCTIONS = {1, 2, 3, 4, 5, 6, 15, 16, 22, 23, 43}  # that they use

# Malformed, or suspicious, or not Modbus at all. What tshark notes about TCP alone does not count.
TROUBLE = "_ws.malformed || (modbus && _ws.expert) || (tcp.len > 0 && !modbus)"

REQUEST = bytes.fromhex("0001 0000 0005 01 2B 0E 01 00")
MALFORMED = {
    "an object longer than its frame": "0001 0000 000A 01 2B 0E 01 01 00 00 01 00 05",
    "an empty reply": "0001 0000 0002 01 2B",
    "another protocol": "0001 0001 000A 01 2B 0E 01 01 00 00 01 00 00",
}


def tshark(file, display_filter, *fields):
    """Lines of tshark: packets that pass the filter, or fields of them."""
    command = ["tshark", "-r", str(file), "-o", f"mbtcp.tcp.port:{SERVER_PORT}",
               "-Y", display_filter]
    for field in fields:
        command += ["-e", field]
    if fields:
        command += ["-T", "fields"]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            check=False)
    if result.returncode != 0:
        sys.exit(f"tshark: {result.stderr}")
    return result.stdout.splitlines()


def record(program, instrument, file):
    """Records the sessions of the clients."""
    gloss = measured_gloss(program, instrument, SAMPLE)
    capture = Capture(file)
    with GonioServer(program, [instrument, *LINES["tcp"], *OPTIONS["ideal"]]) as server:
        with RecordingProxy(server.listening["tcp"], capture) as proxy:
            for client in CLIENTS:
                command = client_command(client, proxy.place, "ideal", gloss)
                if subprocess.run(command, check=False).returncode != 0:
                    sys.exit(f"{client} failed")
    capture.close()


def numbers(file, field):
    """All values of a field."""
    return [int(value) for line in tshark(file, field, field) for value in line.split(",")]


def check_coverage(file):
    """Makes sure that there is something to be found malformed."""
    functions = numbers(file, "modbus.func_code")
    if not FUNCTIONS <= set(functions):
        sys.exit(f"function codes: expected {sorted(FUNCTIONS)}, tshark saw {set(functions)}")
    exceptions = set(numbers(file, "modbus.exception_code"))
    if exceptions != {2, 3, 6}:
        sys.exit(f"exceptions: expected 2, 3 and 6, tshark saw {exceptions}")
    if not any("," in ids for ids in tshark(file, "mbtcp", "mbtcp.trans_id")):
        sys.exit("pipelining: no packet has two frames")
    print(f"tshark saw {len(functions)} frames")


def check_that_trouble_is_seen(file):
    """Makes sure that tshark notices what is malformed."""
    for what, reply in MALFORMED.items():
        capture = Capture(file)
        conversation = Conversation(capture, 50000)
        conversation.add(True, ACK | PUSH, REQUEST)
        conversation.add(False, ACK | PUSH, bytes.fromhex(reply))
        capture.close()
        if not tshark(file, TROUBLE):
            sys.exit(f"tshark does not notice {what}")


def main():
    """The check."""
    program, instrument = sys.argv[1:]
    if not shutil.which("tshark"):
        sys.exit("tshark is not installed; `ci/install-packages test` does that")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "clients.pcap"
        record(program, instrument, file)
        check_coverage(file)
        trouble = tshark(file, TROUBLE)
        if trouble:
            sys.exit("tshark finds fault with\n" + "\n".join(trouble))
        check_that_trouble_is_seen(pathlib.Path(folder) / "malformed.pcap")


if __name__ == "__main__":
    main()
