#!/usr/bin/env python3
"""Lets gonio-conformance judge a Modbus server, and checks that exactly the known cases fail.

    judge_server.py GONIO_CONFORMANCE SERVER PROFILE [COMMAND ...]

SERVER is a key of EXPECTED; COMMAND starts it, and prints {"tcp": "HOST:PORT"} as its first line.
With --table the counts by group of clauses are printed, for standards/modbus/README.md.
"""

import argparse
import collections
import json
import select
import subprocess
import sys

ANNOUNCED_WITHIN_S = 60.0
TIMEOUT = "2 s"  # libmodbus stalls for 0.5 s now and then
GROUPS = ("functions", "exceptions", "tcp", "serial", "own")

# Cases that fail, by server; see standards/modbus/README.md for what they mean.
EXPECTED = {
    "gonio": set(),
    "libmodbus": {
        "exception_between_requests", "ff_300_times_closes", "ff_300_times_over_tcp",
        "function_code_0", "function_code_83h", "http", "http_closes", "length_0", "length_0_closes", "length_1",
        "length_1_closes", "length_20_of_6", "length_255_closes", "length_65535",
        "length_65535_closes", "mask_write_register_short", "protocol_id_1",
        "protocol_id_1_closes", "protocol_id_ffff", "read_exception_status",
        "read_exception_status_unknown", "read_holding_registers_short",
        "read_holding_registers_trailing_bytes", "read_write_registers_122",
        "read_write_registers_data_missing", "report_server_id_on_tcp", "tls_client_hello",
        "tls_client_hello_closes", "unit_99", "write_coil_1234_nowhere",
        "write_coils_byte_count_too_long", "write_register_short", "write_registers_data_missing"},
    "pymodbus": {
        "diagnostics_on_tcp", "encapsulated_other_mei_type", "ff_300_times_closes", "http_closes",
        "identification_of_level_83h", "identification_read_code_0",
        "identification_unknown_object", "identification_unknown_object_in_stream",
        "length_0_closes", "length_1_closes", "length_20_of_6", "length_255_closes",
        "length_65535_closes", "mask_write_register_short", "protocol_id_1",
        "protocol_id_1_closes", "protocol_id_ffff", "read_exception_status_unknown",
        "read_file_record_unknown", "read_holding_registers_short",
        "read_holding_registers_trailing_bytes", "read_write_registers_122",
        "read_write_registers_data_missing", "report_server_id_on_tcp", "request_and_a_half",
        "request_in_three_parts", "tls_client_hello_closes", "unit_99", "write_124_registers",
        "write_124_registers_closes", "write_coil_1234", "write_coil_1234_changes_nothing",
        "write_coil_1234_nowhere", "write_coil_ff01", "write_register_short",
        "write_registers_data_missing"},
}


def announcement(process):
    """Where a server listens, by its first line."""
    if not select.select([process.stdout], [], [], ANNOUNCED_WITHIN_S)[0]:
        sys.exit("the server announces nothing")
    return json.loads(process.stdout.readline())


def judged(program, url, profile):
    """The results of all cases, by the lines of the report."""
    result = subprocess.run(
        [program, "modbus", "--device", url, "--profile", profile, "--timeout", TIMEOUT,
         "--format", "json"],
        stdout=subprocess.PIPE, check=False, text=True)
    if result.returncode not in (0, 1):
        sys.exit(f"gonio-conformance ended with {result.returncode}")
    lines = [json.loads(line) for line in result.stdout.splitlines()]
    return [line for line in lines if line.get("record") == "case"]


def table(cases):
    """Counts by group of clauses, as a table."""
    counts = collections.defaultdict(collections.Counter)
    for case in cases:
        counts[case["clause"].split("/")[0]][case["verdict"]] += 1
    rows = ["| clauses | passed | failed | skipped |", "|---|---|---|---|"]
    for group in GROUPS:
        count = counts[group]
        rows.append(f"| `{group}` | {count['pass']} | {count['fail']} | {count['skipped']} |")
    return "\n".join(rows)


def main():
    """Judges. @return  0 if the cases that fail are those that are known."""
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--line", choices=("tcp", "rtu"), default="tcp")
    parser.add_argument("program")
    parser.add_argument("server", choices=EXPECTED)
    parser.add_argument("profile")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    with subprocess.Popen(arguments.command, stdout=subprocess.PIPE, text=True) as server:
        try:
            place = announcement(server)[arguments.line]
            url = f"modbus://{place}" if arguments.line == "tcp" else f"modbus-rtu:{place}"
            cases = judged(arguments.program, url, arguments.profile)
        finally:
            server.terminate()
    failed = {case["id"] for case in cases if case["verdict"] not in ("pass", "skipped")}
    if arguments.table:
        print(table(cases))
        print(*sorted(failed), sep="\n")
        return 0
    known = EXPECTED[arguments.server]
    for case in sorted(failed - known):
        print(f"{arguments.server}: expected {case} to pass, found that it fails")
    for case in sorted(known - failed):
        print(f"{arguments.server}: expected {case} to fail, found that it passes")
    passed = sum(case["verdict"] == "pass" for case in cases)
    print(f"{arguments.server}: {passed} passed, {len(failed)} failed of {len(cases)}")
    return 0 if failed == known and passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
