#!/usr/bin/env python3
"""Writes the sample records of this folder with the programs that plants use.

Needs numpy, scipy and gnumeric (ssconvert, the spreadsheet).  pyuff is used where it is installed; without it the
universal files follow the published description of data set 58 (see ORIGIN.md).

Every file holds 40 samples at 20 kHz of the same two channels:
    force            976.2 + 0.1 (i mod 7)            kN
    upper_work_roll  0.01 ((37 i) mod 101 - 50)       g
"""
import json
import locale
import os
import struct
import subprocess
import sys

import numpy as np
import scipy.io

n, rate = 40, 20000
i = np.arange(n)
time = i / rate
force = 976.2 + 0.1 * (i % 7)
acceleration = 0.01 * ((37 * i) % 101 - 50)
here = os.path.dirname(os.path.abspath(__file__))


def path(name):
    return os.path.join(here, name)


def numpy_text():
    np.savetxt(path("numpy-savetxt.csv"), np.column_stack([time, force, acceleration]), delimiter=",",
               header="time [s],force [kN],upper_work_roll [g]", comments="")


def numpy_arrays():
    units = {"force": "kN", "upper_work_roll": "g"}
    records = np.zeros(n, dtype=[("s", "<i8"), ("force", "<f4"), ("upper_work_roll", "<f4")])
    records["s"], records["force"], records["upper_work_roll"] = 400000 + i, force, acceleration
    np.save(path("numpy-structured.npy"), records)
    np.save(path("numpy-big-endian.npy"), np.column_stack([force, acceleration]).astype(">f8"))
    np.save(path("numpy-fortran.npy"), np.asfortranarray(np.column_stack([force, acceleration])))
    for name in ("numpy-structured", "numpy-big-endian", "numpy-fortran"):
        with open(path(name + ".json"), "w") as out:
            json.dump({"rate": rate, "start": "2026-01-05T10:00:00Z", "units": units}, out)


def scipy_mat():
    values = {"fs": float(rate), "force": force, "upper_work_roll": acceleration, "note": "pass 1",
              "settings": np.eye(3)}
    scipy.io.savemat(path("scipy-v5.mat"), values)
    scipy.io.savemat(path("scipy-compressed.mat"), values, do_compression=True)


def spreadsheet():
    """A workbook text exported by the spreadsheet in the locales of the plant and of the office."""
    source = path("sheet.csv")
    with open(source, "w") as out:
        out.write("time [s],force [kN],upper_work_roll [g]\n")
        for row in zip(time, force, acceleration):
            out.write("%.5f,%.1f,%.2f\n" % row)
    book = path("sheet.gnumeric")
    environment = dict(os.environ, LC_ALL="C.UTF-8")
    subprocess.run(["ssconvert", source, book], check=True, env=environment, stderr=subprocess.DEVNULL)
    subprocess.run(["ssconvert", "-T", "Gnumeric_stf:stf_assistant", "-O", "separator=, format=raw",
                    book, path("spreadsheet-english.csv")], check=True, env=environment, stderr=subprocess.DEVNULL)
    german = dict(os.environ, LC_ALL="de_DE.UTF-8")
    subprocess.run(["ssconvert", "-T", "Gnumeric_stf:stf_assistant", "-O", "separator=; format=preserve eol=windows",
                    book, path("spreadsheet-german.txt")], check=True, env=german, stderr=subprocess.DEVNULL)
    os.replace(path("spreadsheet-german.txt"), path("spreadsheet-german.csv"))
    os.remove(source)
    os.remove(book)


def german_texts():
    """The same as Excel saves it in Germany: as CSV in Windows-1252 and as Unicode text; written here in its form."""
    lines = ["Zeit [s];Kraft [kN];Beschleunigung [m/s\u00b2]"]
    for t, f, a in zip(time, force, acceleration):
        lines.append(("%.5f;%.1f;%.6f" % (t, f, 9.80665 * a)).replace(".", ","))
    with open(path("excel-german-1252.csv"), "wb") as out:
        out.write(("\r\n".join(lines) + "\r\n").encode("cp1252"))
    with open(path("excel-unicode.txt"), "wb") as out:
        out.write("\ufeff".encode("utf-16-le") + ("\r\n".join(lines).replace(";", "\t") + "\r\n").encode("utf-16-le"))


def oscilloscopes():
    """Forms of two makers, written here: names and units above the numbers."""
    with open(path("oscilloscope-tektronix.csv"), "w", newline="") as out:
        out.write("Model,MSO24\r\nFirmware Version,2.0.3\r\n\r\nWaveform Type,ANALOG,,\r\nPoint Format,Y,,\r\n"
                  "Horizontal Units,s,,\r\nSample Interval,5e-05,,\r\nRecord Length,40,,\r\n"
                  "Vertical Units,V,V,\r\nLabel,force,accel,\r\nTIME,CH1,CH2\r\n")
        for t, f, a in zip(time, force, acceleration):
            out.write("%.6e,%.5e,%.5e\r\n" % (t - 1e-3, f / 1000, a))
    with open(path("oscilloscope-keysight.csv"), "w", newline="") as out:
        out.write("x-axis,1,2\r\nsecond,Volt,Volt\r\n")
        for t, f, a in zip(time, force, acceleration):
            out.write("%+.8E,%+.5E,%+.5E\r\n" % (t - 1e-3, f / 1000, a))


def universal_set(name, unit, data, kind, order="<"):
    """One data set 58; kind: "text", "binary"."""
    head = "%6i\n%6i" % (-1, 58)
    if kind == "binary":
        head += "b%6i%6i%12i%12i%6i%6i%12i%12i\n" % (1 if order == "<" else 2, 2, 11, 8 * n, 0, 0, 0, 0)
    else:
        head += " " * 74 + "\n"
    for line in (name, "NONE", "05-Jan-26 10:00:00", "NONE", "NONE"):
        head += "%-80s\n" % line
    head += "%5i%10i%5i%10i %10s%10i%4i %10s%10i%4i\n" % (1, 0, 0, 0, "NONE", 1, 3, "NONE", 0, 0)
    head += "%10i%10i%10i%13.5e%13.5e%13.5e\n" % (4, n, 1, 0, 1 / rate, 0)
    for axis, label, its_unit in ((17, "Time", "s"), (12, name, unit), (0, "NONE", "NONE"), (0, "NONE", "NONE")):
        head += "%10i%5i%5i%5i %-20s %-20s\n" % (axis, 0, 0, 0, label, its_unit)
    if kind == "binary":
        body = struct.pack(order + "%id" % n, *data)
    else:
        body = "".join("".join("%20.11e" % x for x in data[k:k + 4]) + "\n" for k in range(0, n, 4)).encode()
    return head.encode() + body + ("%6i\n" % -1).encode()


def universal_files():
    channels = [("force", "kN", force), ("upper_work_roll", "g", acceleration)]
    try:
        import pyuff
    except ImportError:
        pyuff = None
    for name, kind, order in (("uff58-text.uff", "text", "<"), ("uff58b-little.uff", "binary", "<"),
                              ("uff58b-big.uff", "binary", ">")):
        if pyuff and order == "<":
            file = pyuff.UFF(path(name))
            for k, (channel, unit, data) in enumerate(channels):
                file.write_sets({"type": 58, "binary": int(kind == "binary"), "func_type": 1, "rsp_node": 1, "rsp_dir": 3,
                                 "ref_node": 0, "ref_dir": 0, "data": data, "x": time, "abscissa_spacing": 1,
                                 "abscissa_spec_data_type": 17, "abscissa_axis_lab": "Time",
                                 "abscissa_axis_units_lab": "s", "ordinate_spec_data_type": 12,
                                 "ordinate_axis_lab": channel, "ordinate_axis_units_lab": unit,
                                 "orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0, "id1": channel},
                                "overwrite" if k == 0 else "add")
            continue
        with open(path(name), "wb") as out:
            for channel, unit, data in channels:
                out.write(universal_set(channel, unit, data, kind, order))


if __name__ == "__main__":
    numpy_text()
    numpy_arrays()
    scipy_mat()
    german_texts()
    oscilloscopes()
    universal_files()
    spreadsheet()
