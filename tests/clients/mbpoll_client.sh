#!/usr/bin/env bash
# A session with the glossmeter through mbpoll, over TCP or a serial line.
#
#   mbpoll_client.sh HOST:PORT|DEVICE SERIAL_NUMBER SAMPLE TOLERANCE GLOSS_1 GLOSS_2 GLOSS_3
#
# mbpoll makes a connection for every request. It has no mask write, no read/write multiple and no
# function code 43.
set -euo pipefail

place=$1 serial_number=$2 sample=$3 tolerance=$4
computed=("${@:5}")
deadline_s=60

case $place in
  *:*) line=(-m tcp -p "${place##*:}") where=${place%:*} ;;
  *) line=(-m rtu -b 19200 -P none) where=$place ;;
esac

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# mbpoll OPTION... [-- VALUE...]: one request to unit 1, with PDU addresses and high words first.
ask() {
  local options=() values=()
  while (($# > 0)) && [[ $1 != -- ]]; do
    options+=("$1")
    shift
  done
  values=("${@:2}")
  mbpoll "${line[@]}" -a 1 -0 -B -1 -q -o 10 "${options[@]}" "$where" "${values[@]}"
}

# read_values TYPE ADDRESS COUNT: the values, in one line. TYPE as of mbpoll: table and form.
read_values() { ask -t "$1" -r "$2" -c "$3" | sed -n 's/^\[[0-9]*\]:[[:space:]]*//p' | xargs; }

# write_values TABLE ADDRESS VALUE...: 0 coils, 4 holding registers.
write_values() { ask -t "$1" -r "$2" -- "${@:3}" >/dev/null; }

# expect WHAT FOUND EXPECTED
expect() { [[ $2 == "$3" ]] || fail "$1: expected '$3', found '$2'"; }

# expect_refusal MESSAGE OPTION...: what mbpoll says of the exception.
expect_refusal() {
  local expected=$1 found
  shift
  if found=$(ask "$@" 2>&1); then fail "$*: expected '$expected', found an answer"; fi
  [[ $found == *"$expected"* ]] || fail "$*: expected '$expected', found '$found'"
}

# read_text ADDRESS COUNT
read_text() {
  local word escaped=
  for word in $(read_values 3:hex "$1" "$2"); do
    escaped+="\\x${word:2:2}\\x${word:4:2}"
  done
  printf '%b' "${escaped//'\x00'/}"
}

# wait_for TABLE ADDRESS VALUE: asks until a bit or a register has a value.
wait_for() {
  local end=$((SECONDS + deadline_s))
  until [[ $(read_values "$1" "$2" 1) == "$3" ]]; do
    ((SECONDS < end)) || fail "waited too long for $3 at $2"
  done
}

# is_near A B TOLERANCE
is_near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { exit !(a - b <= t && b - a <= t) }'; }

# carry_out TABLE ADDRESS VALUE: starts a command and waits until it is done.
carry_out() {
  local before
  before=$(read_values 3 7 1)
  write_values "$@"
  wait_for 3 9 2
  expect "command sequence" "$(read_values 3 7 1)" $((before + 1))
}

# Who it is.
expect "serial number" "$(read_text 400 8)" "$serial_number"
expect "model" "$(read_text 424 16)" "Triangle Gloss"
if [[ ${line[1]} == rtu ]]; then
  report=$(mbpoll "${line[@]}" -a 1 -u "$where")
  [[ $report == *"Status: On"*"Data  : gonio Triangle Gloss"* ]] || fail "report server id: $report"
fi

# Types and word order.
expect "test float" "$(read_values 3:float 300 1)" -123.45
expect "test integers" "$(read_values 3 304 2)" "53191 (-12345) 54321 (-11215)"
expect "32-bit test integers" "$(read_values 3:int 306 2)" "-123456789 305419896"
expect "test text" "$(read_text 310 4)" -123.45

# Calibrate on the tile, when the lamp is warm.
wait_for 1 3007 0
write_values 4 1100 1
expect "lies on the tile" "$(read_values 1 3006 1)" 1
carry_out 4 1000 2
expect "calibrated" "$(read_values 3 216 3)" "1 1 1"

# Measure; floats against the computation and against integers. mbpoll prints six digits.
write_values 4 1100 3 "$sample"
carry_out 0 2000 1
read -ra gloss < <(read_values 3:float 18 3)
read -ra tenths < <(read_values 3 24 3)
expect "number of angles" "${#gloss[@]} ${#tenths[@]}" "3 3"
for i in 0 1 2; do
  is_near "${gloss[i]}" "${computed[i]}" "$(awk -v t="$tolerance" 'BEGIN { print t + 0.0005 }')" ||
    fail "gloss: expected ${computed[i]} within $tolerance, found ${gloss[i]}"
  is_near "${tenths[i]}e-1" "${gloss[i]}" 0.0505 ||
    fail "${tenths[i]} tenths of a gloss of ${gloss[i]}"
done
expect "gloss by function code 3" "$(read_values 4:float 18 3)" "${gloss[*]}"

# Exceptions.
expect_refusal "Illegal data address" -t 3 -r 900
expect_refusal "Illegal data address" -t 4 -r 1102 -- 1
expect_refusal "Illegal data value" -t 4 -r 1002 -- 99
write_values 4 1002 2 # continuous
write_values 4 1000 1
expect "busy" "$(read_values 1 3001 1)" 1
expect "coil of what runs" "$(read_values 0 2000 5)" "1 0 0 0 0"
expect_refusal "Slave device or server is busy" -t 4 -r 1000 -- 1
write_values 0 2003 1 1 # stop, acknowledge alarms
expect "busy after stop" "$(read_values 1 3001 1)" 0
write_values 4 1002 0 # single
