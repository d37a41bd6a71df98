#!/usr/bin/env python3
"""Lets one Modbus client work with `gonio serve`, and ends with its exit status.

    run_client.py GONIO INSTRUMENT CLIENT tcp|rtu ideal|as_built|wrong

CLIENT is the name of a script in this folder without `_client` and extension. It is called with
where to connect to, the serial number, the index of a sample, by how much its readings may be
wrong [GU], and what `gonio measure` computes for that sample, by angle.

ideal: the instrument reads exactly what is computed. as_built: with noise, drift and a warm-up of
its lamp, a hundred times faster than in life. wrong: as ideal, but the client is told wrong values
and has to complain.
"""

import argparse
import pathlib
import shutil
import signal
import subprocess
import sys

from gonio_server import GonioServer, SAMPLES, SERIAL_NUMBER, measured_gloss

FOLDER = pathlib.Path(__file__).resolve().parent
SAMPLE = "black_high_gloss"

WRONG_BY_GU = 0.01

# Noise of 0.05 GU, steps of 0.1 GU and drift since the calibration stay far below.
AS_BUILT_TOLERANCE_GU = 1.0

OPTIONS = {"ideal": ["--ideal"], "as_built": ["--speed", "100"], "wrong": ["--ideal"]}
TOLERANCE_GU = {"ideal": 0.0, "as_built": AS_BUILT_TOLERANCE_GU, "wrong": 0.0}
LINES = {"tcp": ["--tcp", "127.0.0.1:0"], "rtu": ["--rtu", "pty"]}

COMMANDS = {
    "mbpoll": ["bash", "mbpoll_client.sh"],
    "pymodbus": [sys.executable, "pymodbus_client.py"],
    "modbus_serial": ["node", "modbus_serial_client.js"],
    "jsmodbus": ["node", "jsmodbus_client.js"],
}


def is_installed(client):
    """Whether there is the program or library that a client is written for."""
    if client == "mbpoll":
        return shutil.which("mbpoll") is not None
    if client == "pymodbus":
        loads = [sys.executable, "-c", "import pymodbus.client, serial_asyncio"]
        return subprocess.run(loads, stderr=subprocess.DEVNULL, check=False).returncode == 0
    library = FOLDER / "node_modules" / client.replace("_", "-")
    return shutil.which("node") is not None and library.is_dir()


def client_command(client, place, mode, gloss):
    """The command line of a client. Ends the program if the client is not installed."""
    if not is_installed(client):
        sys.exit(f"{client} is not installed; `ci/install-packages test` does that")
    interpreter, script = COMMANDS[client]
    return [interpreter, str(FOLDER / script), place, SERIAL_NUMBER, str(SAMPLES.index(SAMPLE)),
            str(TOLERANCE_GU[mode]), *(repr(value) for value in gloss)]


def exit_status(command, mode):
    """Runs a client. @return  0 if it does as it should."""
    if mode != "wrong":
        return subprocess.run(command, check=False).returncode
    result = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
    if result.returncode == 1 and "gloss: expected" in result.stderr:
        return 0
    print(f"wrong values: exit status {result.returncode}, {result.stderr}", file=sys.stderr)
    return 1


def main():
    """Runs the client. @return  its exit status."""
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("instrument")
    parser.add_argument("client", choices=COMMANDS)
    parser.add_argument("line", choices=LINES)
    parser.add_argument("mode", choices=OPTIONS)
    arguments = parser.parse_args()
    mode = arguments.mode
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended from outside"))

    gloss = measured_gloss(arguments.program, arguments.instrument, SAMPLE)
    if mode == "wrong":
        gloss = [value + WRONG_BY_GU for value in gloss]
    options = [arguments.instrument, *LINES[arguments.line], *OPTIONS[mode]]
    with GonioServer(arguments.program, options) as server:
        place = server.listening[arguments.line]
        return exit_status(client_command(arguments.client, place, mode, gloss), mode)


if __name__ == "__main__":
    sys.exit(main())
