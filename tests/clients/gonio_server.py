"""Starts `gonio serve`, tells where it listens, and ends it."""

import json
import select
import subprocess
import sys

ANNOUNCED_WITHIN_S = 60.0
ENDED_WITHIN_S = 10.0

SERIAL_NUMBER = "TG-2813-0042"  # of fixtures/instruments/triangle_gloss.yaml
SAMPLES = ["black_matt", "red_satin", "black_semi_gloss", "black_high_gloss",
           "black_glass_n1567", "perfect_mirror"]  # in its order


class GonioServer:
    """A running `gonio serve`; leaving its context ends it and checks that it ended well."""

    def __init__(self, program, arguments):
        self._process = subprocess.Popen(
            [program, "serve", *arguments, "--format", "json"], stdout=subprocess.PIPE, text=True)
        try:
            self.listening = self._announcement()
        except BaseException:
            self._process.kill()
            self._process.wait()
            raise

    def _announcement(self):
        if not select.select([self._process.stdout], [], [], ANNOUNCED_WITHIN_S)[0]:
            sys.exit("gonio serve announces nothing")
        line = self._process.stdout.readline()
        if not line:
            sys.exit(f"gonio serve ended with {self._process.wait()}")
        return json.loads(line)

    def __enter__(self):
        return self

    def __exit__(self, exception_type, exception, traceback):
        self._process.terminate()
        try:
            status = self._process.wait(ENDED_WITHIN_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            sys.exit("gonio serve does not end on SIGTERM")
        if status != 0:
            sys.exit(f"gonio serve ended with {status}")


def measured_gloss(program, instrument, sample):
    """What `gonio measure` computes, by angle, the steepest first."""
    result = subprocess.run(
        [program, "measure", "--instrument", instrument, "--sample", sample, "--format", "json"],
        stdout=subprocess.PIPE, check=True, text=True)
    return [geometry["gloss_gu"] for geometry in json.loads(result.stdout)["geometries"]]
