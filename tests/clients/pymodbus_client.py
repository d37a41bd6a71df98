#!/usr/bin/env python3
"""A session with the glossmeter through pymodbus, over TCP or a serial line.

    pymodbus_client.py HOST:PORT|DEVICE SERIAL_NUMBER SAMPLE TOLERANCE GLOSS_1 GLOSS_2 GLOSS_3
"""

import logging
import struct
import sys
import time

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.mei_message import ReadDeviceInformationRequest
from pymodbus.register_read_message import ReadWriteMultipleRegistersRequest
from pymodbus.register_write_message import MaskWriteRegisterRequest

TIMEOUT_S = 10
DEADLINE_S = 60
POLL_INTERVAL_S = 0.005

ILLEGAL_ADDRESS, ILLEGAL_VALUE, BUSY = 2, 3, 6  # exceptions
MEASURE, CALIBRATE, STOP = 1, 2, 4  # commands
DONE = 2  # state of a command
TILE, SAMPLE = 1, 3  # what lies on the port
SINGLE, CONTINUOUS = 0, 2  # measuring modes


def expect(what, found, expected):
    """Ends the program if something is not as it should be."""
    if found != expected:
        sys.exit(f"{what}: expected {expected!r}, found {found!r}")


def decode(registers, form):
    """Values of registers; form as of struct, e.g. "3f"."""
    data = struct.pack(f">{len(registers)}H", *registers)
    return list(struct.unpack(">" + form, data))


def float32(value):
    """The float32 nearest to a value."""
    return struct.unpack("f", struct.pack("f", value))[0]


def text(registers):
    """ASCII text in registers, filled up with NUL."""
    return decode(registers, f"{2 * len(registers)}s")[0].rstrip(b"\0").decode("ascii")


class Glossmeter:
    """The instrument, as its register map describes it."""

    def __init__(self, place):
        host, colon, port = place.partition(":")
        if colon:
            self._client = ModbusTcpClient(host, port=int(port), timeout=TIMEOUT_S)
        else:
            # A pseudo terminal has no parity: glibc refuses to set another one.
            self._client = ModbusSerialClient(place, baudrate=19200, parity="N", timeout=TIMEOUT_S)
        if not self._client.connect():
            sys.exit(f"cannot connect to {place}")

    def call(self, method, *arguments):
        """Calls a method of the client and lets nothing pass but a good answer."""
        return self._good(getattr(self._client, method)(*arguments, slave=1))

    def execute(self, request, **arguments):
        """Sends a request whose method in pymodbus 3.0 forgets the unit."""
        return self._good(self._client.execute(request(**arguments, unit=1)))

    @staticmethod
    def _good(answer):
        if answer.isError():
            sys.exit(str(answer))
        return answer

    def refusal(self, method, *arguments):
        """The exception with which a call is refused."""
        answer = getattr(self._client, method)(*arguments, slave=1)
        return getattr(answer, "exception_code", f"no exception but {answer}")

    def inputs(self, address, count):
        """Input registers."""
        return self.call("read_input_registers", address, count).registers

    def identification(self, read_code, object_id=0):
        """Objects of function code 43/14, by number."""
        return self.execute(ReadDeviceInformationRequest, read_code=read_code,
                            object_id=object_id).information

    def wait_for(self, what, condition):
        """Asks until a condition holds."""
        deadline = time.monotonic() + DEADLINE_S
        while not condition():
            if time.monotonic() > deadline:
                sys.exit(f"waited too long for {what}")
            time.sleep(POLL_INTERVAL_S)

    def wait_until_warm(self):
        """Waits for the end of the warm-up."""
        self.wait_for("the lamp", lambda: not self.call("read_discrete_inputs", 3007, 1).bits[0])

    def carry_out(self, what, start):
        """Starts a command and waits until it is done."""
        sequence = self.inputs(7, 1)[0]
        start()
        self.wait_for(what, lambda: self.inputs(9, 1)[0] >= DONE)
        expect(what, self.inputs(7, 4)[0::2], [(sequence + 1) % 65536, DONE])

    def close(self):
        """Ends the connection."""
        self._client.close()


def identify(meter, serial_number):
    """Who it is, in both ways."""
    basic = meter.identification(1)
    expect("vendor", basic[0], b"gonio")
    expect("product code", basic[1], b"Triangle Gloss")
    expect("serial number", meter.identification(4, 0x80)[0x80], serial_number.encode())
    expect("serial number in registers", text(meter.inputs(400, 8)), serial_number)
    expect("model in registers", text(meter.inputs(424, 16)), "Triangle Gloss")


def try_test_registers(meter):
    """Types and word order, with values that are known."""
    expect("floats", decode(meter.inputs(300, 2), "f"), [float32(-123.45)])
    low, high = meter.inputs(302, 2)
    expect("float with the low word first", decode([high, low], "f"), [float32(-123.45)])
    expect("integers", decode(meter.inputs(304, 6), "hHiI"),
           [-12345, 54321, -123456789, 0x12345678])
    expect("text", text(meter.inputs(310, 4)), "-123.45")


def calibrate(meter):
    """On the tile, with a write to the command register."""
    meter.call("write_register", 1100, TILE)
    expect("lies on the tile", meter.call("read_discrete_inputs", 3006, 1).bits[0], True)
    meter.carry_out("calibration", lambda: meter.call("write_register", 1000, CALIBRATE))
    expect("calibrated", meter.inputs(216, 3), [1, 1, 1])


def measure(meter, sample, tolerance_gu, expected_gu):
    """Floats and integers of one snapshot, against each other and against the computation."""
    meter.call("write_registers", 1100, [SAMPLE, sample])
    before = decode(meter.inputs(5, 2), "I")[0]
    meter.carry_out("measurement", lambda: meter.call("write_coil", 2000, True))
    snapshot = meter.inputs(0, 114)
    expect("count of readings", decode(snapshot[5:7], "I"), [before + 1])
    gloss = decode(snapshot[18:24], "3f")
    tenths = decode(snapshot[24:27], "3h")
    swapped = [snapshot[i ^ 1] for i in range(92, 98)]
    expect("states of the readings", snapshot[27:30], [1, 1, 1])
    expect("floats with the low word first", decode(swapped, "3f"), gloss)
    for found, integer, computed in zip(gloss, tenths, expected_gu):
        if abs(found - float32(computed)) > tolerance_gu:
            sys.exit(f"gloss: expected {computed} within {tolerance_gu}, found {found}")
        if abs(integer - 10 * found) > 0.5001:  # half a step, and rounding of float32
            sys.exit(f"gloss as integer: expected {10 * found} rounded, found {integer}")
    again = meter.call("read_holding_registers", 18, 6).registers
    expect("gloss by function code 3", again, snapshot[18:24])


def change_settings(meter):
    """With mask write, and with a write and a read in one request."""
    expect("measured channels", meter.call("read_holding_registers", 1006, 1).registers, [0b111])
    meter.execute(MaskWriteRegisterRequest, address=1006, and_mask=0xFFFD, or_mask=0)
    answer = meter.execute(ReadWriteMultipleRegistersRequest, read_address=1006, read_count=1,
                           write_address=1003, write_registers=[7])
    expect("measured channels after mask write", answer.registers, [0b101])
    expect("number of readings", meter.call("read_holding_registers", 1003, 1).registers, [7])
    meter.call("write_register", 1006, 0b111)


def provoke_exceptions(meter):
    """Each for its reason; the instrument stays as it is."""
    expect("exception at a hole", meter.refusal("read_input_registers", 900, 1), ILLEGAL_ADDRESS)
    expect("exception of a constant", meter.refusal("write_register", 1102, 1), ILLEGAL_ADDRESS)
    expect("exception of a mode that is none", meter.refusal("write_register", 1002, 99),
           ILLEGAL_VALUE)
    meter.call("write_register", 1002, CONTINUOUS)
    meter.call("write_register", 1000, MEASURE)
    expect("busy", meter.call("read_discrete_inputs", 3001, 1).bits[0], True)
    expect("coil of what runs", meter.call("read_coils", 2000, 5).bits[:5],
           [True, False, False, False, False])
    expect("exception while busy", meter.refusal("write_register", 1000, MEASURE), BUSY)
    meter.call("write_coils", 2003, [True, True])  # stop, acknowledge alarms
    expect("busy after stop", meter.call("read_discrete_inputs", 3001, 1).bits[0], False)
    meter.call("write_register", 1002, SINGLE)


def main():
    """The session."""
    logging.disable(logging.CRITICAL)  # an exception that is provoked is no error
    place, serial_number, sample, tolerance, *gloss = sys.argv[1:]
    meter = Glossmeter(place)
    identify(meter, serial_number)
    try_test_registers(meter)
    meter.wait_until_warm()
    calibrate(meter)
    measure(meter, int(sample), float(tolerance), [float(value) for value in gloss])
    change_settings(meter)
    provoke_exceptions(meter)
    meter.close()


if __name__ == "__main__":
    main()
