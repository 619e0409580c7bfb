#!/usr/bin/env python3
"""Plays random editing into the window for a while, and watches its memory.

usage: soak.py LIGHTWELL_VIEW FILE.gto MINUTES [SEED]

Needs a display (xvfb-run). Keys and mouse are drawn at random, the same for the same seed; what they
do is up to the window: lamps are dragged, added, deleted, switched, undone, saved and loaded, pictures
change, people walk and read lux, files are read again. At the end the window is asked to stop, as by
Ctrl+C, so that leak sanitizers have their say.

Exit status: 0, or 1 if the window failed, was told off by a sanitizer, or grew.
"""

import os
import random
import signal
import subprocess
import sys
import tempfile
import time

SIZE = (480, 360)
FRAMES = 400_000
# Of the resident memory, along the line that fits it best after the first third, when all buffers
# have had the time to grow. Single samples jump by some per cent: visitors add and delete lamps.
MOST_GROWTH = 0.05
KEYS = "w a s d q e n x l space tab home minus period f1".split()
RARE = ["f5", "delete"]
PICTURES = [f"digit_{k}" for k in range(1, 8)]
CONTROLLED = ["z", "z", "z", "y", "s", "o"]


def tap(key):
    return f"key {key} down\nframe 0.05\nkey {key} up\nframe 0.05\n"


def drag(rng, button):
    at = [rng.randrange(SIZE[0]), rng.randrange(SIZE[1])]
    text = f"cursor {at[0]} {at[1]}\nframe 0.05\nbutton {button} down\nframe 0.05\n"
    for _ in range(rng.randrange(1, 8)):
        at = [min(max(a + rng.randrange(-40, 41), 0), most - 1) for a, most in zip(at, SIZE)]
        text += f"cursor {at[0]} {at[1]}\nframe 0.05\n"
    return text + f"button {button} up\nframe 0.05\n"


def deed(rng):
    """One thing that a visitor does."""
    kind = rng.random()
    if kind < 0.35:
        return drag(rng, "left")
    if kind < 0.45:
        return drag(rng, "right")
    if kind < 0.60:
        key = rng.choice(CONTROLLED)
        shift = rng.random() < 0.3
        return (
            "key control down\n"
            + ("key shift down\n" if shift else "")
            + tap(key)
            + ("key shift up\n" if shift else "")
            + "key control up\n"
        )
    if kind < 0.70:
        return tap(rng.choice(PICTURES))
    if kind < 0.73:
        return tap(rng.choice(RARE))
    if kind < 0.78:
        return f"wheel {rng.choice([-2, -1, 1, 2])}\nframe 0.05\n"
    return tap(rng.choice(KEYS))


def write_visit(path, rng):
    lamps = os.path.join(os.path.dirname(path), "lamps.toml")
    with open(lamps, "w") as file:
        file.write('[[light]]\ntype = "point"\nposition = [2, 2, 3]\nintensity = 100\n')
    frames = 0
    with open(path, "w") as file:
        while frames < FRAMES:
            text = deed(rng)
            frames += text.count("frame")
            file.write(text)
            # Lamps that come more often than they go would be growth of the visitor's making.
            if rng.random() < 0.01:
                file.write(f"drop {lamps}\nframe 0.05\n")


def own_complaints(text):
    """What sanitizers said of the program itself: leaks of drivers that were unloaded again, which
    nobody can name, or which are taken for the sanitizer that lies beside, are left out."""
    complaints = [
        line
        for line in text.splitlines()
        if "runtime error:" in line or ("ERROR: " in line and "detected memory leaks" not in line)
    ]
    for block in text.split("\n\n"):
        if " leak of " not in block:
            continue
        frames = [line for line in block.splitlines() if line.strip().startswith("#")]
        if not all("<unknown module>" in f or "/libasan.so" in f for f in frames[1:]):
            complaints.append(block.strip())
    return complaints


def resident_mib(pid):
    with open(f"/proc/{pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def growth_along(samples):
    """How much the line of least squares through samples grows, as a share of where it begins."""
    if len(samples) < 3:
        return 0.0
    middle = (len(samples) - 1) / 2
    mean = sum(samples) / len(samples)
    slope = sum((k - middle) * (y - mean) for k, y in enumerate(samples)) / sum(
        (k - middle) ** 2 for k in range(len(samples))
    )
    return 2 * middle * slope / (mean - middle * slope)


def main():
    program, operator, minutes = sys.argv[1], os.path.abspath(sys.argv[2]), float(sys.argv[3])
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    with tempfile.TemporaryDirectory() as folder:
        visit = os.path.join(folder, "visit.txt")
        write_visit(visit, random.Random(seed))
        said = open(os.path.join(folder, "said.txt"), "w+")
        window = subprocess.Popen(
            [os.path.abspath(program), operator, "--size", "%dx%d" % SIZE, "--replay", visit],
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=said,
        )
        begin, samples = time.time(), []
        while window.poll() is None and time.time() - begin < 60 * minutes:
            time.sleep(5)
            if window.poll() is None:
                samples.append(resident_mib(window.pid))
                print(f"{time.time() - begin:6.0f} s  {samples[-1]:8.1f} MiB", flush=True)
        if window.poll() is None:
            window.send_signal(signal.SIGINT)
        status = window.wait()
        said.seek(0)
        text = said.read()
        said.close()
    complaints = own_complaints(text)
    for complaint in complaints:
        print(complaint)
    # 3: stopped on request, 0: all was played before the time was over; a sanitizer that found
    # leaks, of whomever, makes another number of it.
    ended_well = status in (0, 3) or ("stopped on request" in text and " leak of " in text)
    growth = growth_along(samples[len(samples) // 3 :])
    print(f"exit status {status}; grew {100 * growth:.1f} % after the first third")
    return 0 if ended_well and not complaints and growth <= MOST_GROWTH else 1


if __name__ == "__main__":
    sys.exit(main())
