#!/usr/bin/python3
"""Takes the place of LinuxCNC's screen: machine on, home, some moves; the following error to result.json."""

import json
import sys
import time

import linuxcnc

command, status = linuxcnc.command(), linuxcnc.stat()
result = {"max_following_error_mm": 0.0, "sum_of_squares": 0.0, "samples": 0}


def wait(condition, limit_s, what):
    end = time.monotonic() + limit_s
    while time.monotonic() < end:
        status.poll()
        if condition():
            return
        time.sleep(0.005)
    raise RuntimeError("did not come about: " + what)


def watched():
    error = abs(status.joint[0]["ferror_current"])
    result["max_following_error_mm"] = max(result["max_following_error_mm"], error)
    result["sum_of_squares"] += error * error
    result["samples"] += 1
    return status.interp_state == linuxcnc.INTERP_IDLE and status.inpos


def main():
    time.sleep(1.0)
    command.state(linuxcnc.STATE_ESTOP_RESET)
    wait(lambda: status.task_state == linuxcnc.STATE_ESTOP_RESET, 10, "estop reset")
    command.state(linuxcnc.STATE_ON)
    wait(lambda: status.task_state == linuxcnc.STATE_ON, 10, "machine on")
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.teleop_enable(0)
    command.wait_complete()
    command.home(0)
    wait(lambda: status.homed[0], 10, "homed")
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    for line in ("G21 G90 G64", "G1 X20 F1800", "G1 X-20 F1800", "G1 X0 F600"):
        command.mdi(line)
        time.sleep(0.1)
        wait(watched, 20, line)
    status.poll()
    result["position_mm"] = status.joint[0]["input"]
    result["enabled"] = bool(status.joint[0]["enabled"])


try:
    main()
except Exception as problem:  # pylint: disable=broad-except
    result["problem"] = repr(problem)
with open("result.json", "w", encoding="ascii") as file:
    json.dump(result, file)
sys.exit(0)
