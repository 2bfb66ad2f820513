#!/usr/bin/env python3
"""The EDS against CiA 306's rules, by a reader of its own; the DBC with canmatrix, an independent reader, on frames packed here."""

import configparser
import pathlib
import struct
import sys
import tempfile

import program

LIMITS = {2: (-(2**7), 2**7 - 1), 3: (-(2**15), 2**15 - 1), 4: (-(2**31), 2**31 - 1), 5: (0, 2**8 - 1), 6: (0, 2**16 - 1), 7: (0, 2**32 - 1)}
BITS = {2: 8, 3: 16, 4: 32, 5: 8, 6: 16, 7: 32}
TEXT = 9


def number(value, node_id=1):
    total = 0
    for part in value.split("+"):
        total += node_id if part.strip().upper() == "$NODEID" else int(part, 0)
    return total


def check_variable(name, section):
    """Keys, type, access, limits and default of a variable or sub-index."""
    for key in ("ParameterName", "ObjectType", "DataType", "AccessType", "DefaultValue", "PDOMapping"):
        assert key in section, f"[{name}] has no {key}"
    assert len(section["ParameterName"]) <= 241 and section["ParameterName"].isascii(), name
    assert int(section["ObjectType"], 0) == 7, name
    assert section["AccessType"] in ("ro", "wo", "rw", "rwr", "rww", "const"), name
    assert section["PDOMapping"] in ("0", "1"), name
    kind = int(section["DataType"], 0)
    if kind == TEXT:
        return
    low, high = LIMITS[kind]
    default = number(section["DefaultValue"])
    least, most = number(section.get("LowLimit", str(low))), number(section.get("HighLimit", str(high)))
    assert low <= least <= default <= most <= high, f"[{name}] {low} {least} {default} {most} {high}"
    assert not (section["AccessType"] == "const" and section["PDOMapping"] == "1"), name


def check_eds(path):
    eds = configparser.RawConfigParser(comment_prefixes=(";",), delimiters=("=",), strict=True)
    eds.optionxform = str
    eds.read_string(path.read_text(encoding="ascii"))
    assert max(map(len, path.read_text().splitlines())) <= 255
    for key in ("FileName", "FileVersion", "FileRevision", "EDSVersion", "CreationTime", "CreationDate", "ModificationDate"):
        assert eds["FileInfo"][key], key
    assert eds["FileInfo"]["FileName"] == path.name and eds["FileInfo"]["EDSVersion"] == "4.0"
    device = eds["DeviceInfo"]
    for rate in (10, 20, 50, 125, 250, 500, 800, 1000):
        assert device[f"BaudRate_{rate}"] in ("0", "1")
    assert device["Granularity"] == "8" and device["NrOfRXPDO"] == "4" and device["NrOfTXPDO"] == "4"

    listed = set()
    for name in ("MandatoryObjects", "OptionalObjects", "ManufacturerObjects"):
        section = eds[name]
        indices = [int(section[str(i + 1)], 0) for i in range(int(section["SupportedObjects"]))]
        assert len(section) == len(indices) + 1 and indices == sorted(indices), name
        for index in indices:
            assert index not in listed
            if name == "ManufacturerObjects":
                assert 0x2000 <= index < 0x6000
            listed.add(index)
        if name == "MandatoryObjects":
            assert indices == [0x1000, 0x1001, 0x1018]

    objects, described = {}, set()
    for name in eds.sections():
        head, _, sub = name.partition("sub")
        try:
            index = int(head, 16)
        except ValueError:
            continue
        if sub:
            objects[index, int(sub, 16)] = eds[name]
            check_variable(name, eds[name])
            continue
        described.add(index)
        kind = int(eds[name]["ObjectType"], 0)
        if kind == 7:
            objects[index, 0] = eds[name]
            check_variable(name, eds[name])
        else:
            assert kind in (8, 9), name
            subs = [n for n in eds.sections() if n.startswith(head + "sub")]
            assert len(subs) == int(eds[name]["SubNumber"], 0), name
            highest = max(int(n.partition("sub")[2], 16) for n in subs)
            first = eds[head + "sub0"]
            assert int(first["DataType"], 0) == 5
            if not 0x1600 <= index < 0x1C00 and index != 0x1003:  # there sub 0 counts what is mapped, or errors
                assert number(first["DefaultValue"]) == highest, name
    assert listed == described, listed ^ described

    for base, accesses in ((0x1600, ("rw", "rww", "wo")), (0x1A00, ("ro", "rw", "rwr"))):
        for pdo in range(4):
            bits = 0
            for sub in range(1, number(objects[base + pdo, 0]["DefaultValue"]) + 1):
                word = number(objects[base + pdo, sub]["DefaultValue"])
                mapped = objects[word >> 16, word >> 8 & 0xFF]
                assert mapped["PDOMapping"] == "1" and mapped["AccessType"] in accesses, hex(word)
                assert BITS[int(mapped["DataType"], 0)] == word & 0xFF, hex(word)
                bits += word & 0xFF
            assert bits <= 64
    assert number(objects[0x1400, 1]["DefaultValue"], 5) == 0x205
    assert number(objects[0x1801, 1]["DefaultValue"], 5) & 0x7FF == 0x285
    return objects


def check_dbc(path):
    try:
        import canmatrix.formats
    except ImportError:
        print("skipped: python3-canmatrix is not installed, so no independent reader of the DBC")
        return
    matrix = next(iter(canmatrix.formats.loadp(str(path)).values()))

    def decode(identifier, data):
        frame = matrix.frame_by_id(canmatrix.ArbitrationId(identifier, extended=False))
        assert frame is not None and frame.size == len(data), hex(identifier)
        return {name: float(signal.phys_value) for name, signal in frame.decode(data).items()}

    def same(read, wanted):
        assert read.keys() == wanted.keys(), (read, wanted)
        for name, value in wanted.items():
            assert abs(read[name] - value) <= 1e-9 * max(1.0, abs(value)), (name, read[name], value)

    for node in (1, 2):
        for status, position, torque in ((0x1237, -123456789, -500), (0x0250, 2**31 - 1, 32767), (8, -(2**31), -32768)):
            same(decode(0x180 + node, struct.pack("<Hih", status, position, torque)),
                 {"Statusword": status, "PositionActualValue": position, "TorqueActualValue": torque * 1.27e-3})
            same(decode(0x200 + node, struct.pack("<HhB", status, torque, 10)),
                 {"Controlword": status, "TargetTorque": torque * 1.27e-3, "ModesOfOperation": 10})
        same(decode(0x280 + node, struct.pack("<ibH", -7, 10, 0x8250)),
             {"VelocityActualValue": -7, "ModesOfOperationDisplay": 10, "ErrorCode": 0x8250})
        same(decode(0x80 + node, struct.pack("<HB5x", 0x8250, 0x11)), {"ErrorCode": 0x8250, "ErrorRegister": 0x11})
        same(decode(0x700 + node, b"\x05"), {"State": 5})


def main():
    with tempfile.TemporaryDirectory(prefix="feedtwin-test-") as folder:
        out = pathlib.Path(folder) / "one"
        result = program.run("can-files", "--out", out)
        assert result.returncode == 0, result.stderr
        objects = check_eds(out / "feedtwin.eds")
        assert number(objects[0x608F, 1]["DefaultValue"]) == 65536 and number(objects[0x6076, 0]["DefaultValue"]) == 1270
        # two axes
        axis = (program.SOURCE / "tests/kernel/axis.toml").read_text()
        for name, counts in (("x", "4000"), ("y", "8000")):
            (pathlib.Path(folder) / f"{name}.toml").write_text(axis.replace("@counts@", counts))
        (pathlib.Path(folder) / "two.toml").write_text('[server]\naxes = ["x.toml", "y.toml"]\n')
        out = pathlib.Path(folder) / "two"
        result = program.run("can-files", pathlib.Path(folder) / "two.toml", "--out", out)
        assert result.returncode == 0, result.stderr
        for i, counts in enumerate((4000, 8000)):
            assert number(check_eds(out / f"feedtwin.axis{i}.eds")[0x608F, 1]["DefaultValue"]) == counts
        check_dbc(out / "feedtwin.dbc")
        # what can't be written is said, and nothing is left
        result = program.run("can-files", "--out", pathlib.Path(folder) / "two.toml" / "below")
        assert result.returncode == 2 and len(result.stderr.splitlines()) == 1, result.stderr
        result = program.run("can-files", pathlib.Path(folder) / "two.toml", "--node-id", "127", "--out", out)
        assert result.returncode == 2 and "127" in result.stderr, result.stderr
    print("EDS and DBC are as the standards and another reader have them")


if __name__ == "__main__":
    sys.exit(main())
