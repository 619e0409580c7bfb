#!/usr/bin/env python3
"""Plays random editing into the window for a while, and watches its memory.

usage: soak.py LIGHTWELL_VIEW FILE.gto MINUTES [SEED]

Needs a display (xvfb-run). Keys and mouse are drawn at random, the same for the same seed; what they
do is up to the window: lamps are dragged, added, deleted, switched, undone, saved and loaded, pictures
change, people walk and read lux, files are read again. Every few deeds the file is dropped on the
window, which begins the visit anew, and the window tells how many bytes it has in use: memory at an
equal state, which must stay what it is. At the end the window is asked to stop, as by Ctrl+C, so that
leak sanitizers have their say.

The processor that draws in place of a GPU (Mesa's llvmpipe) keeps textures and buffers that were
deleted until one of its up to 64 queued pictures is needed again, tens of MiB of them, some for
minutes. Without threads of its own it queues none, and frees them at once: it is run like that here.

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
DEEDS_OF_A_VISIT = 30
FEWEST_SAMPLES = 9
# Along the line that fits samples best after the first third, when all buffers have had the time to
# grow, as a share of where the line begins: of the bytes in use, and of the resident memory.
MOST_GROWTH = 0.05
# Along the line of the bytes in use, for each deed (one in three is an edit), where that makes more
# than what the panel and the driver hold more or less of from one beginning to the next.
MOST_BYTES_A_DEED = 100
UNSTEADY_BYTES = 2**18
KEYS = "w a s d q e n x l space tab home minus period f1".split()
# Switching the selected lamp and adding one: what edits for certain. A drag must meet a handle first.
EDITS = ["space", "space", "l"]
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
    if rng.random() < 0.3:
        return tap(rng.choice(EDITS))
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


def return_to_start(operator, visit):
    """A visit from its beginning, and how many bytes are in use there."""
    return f"focus lost\ndrop {operator}\nframes 5 0.05\nmemory in-use-{visit:05}.txt\nframe 0.05\n"


def write_visit(path, operator, rng):
    lamps = os.path.join(os.path.dirname(path), "lamps.toml")
    with open(lamps, "w") as file:
        file.write('[[light]]\ntype = "point"\nposition = [2, 2, 3]\nintensity = 100\n')
    frames = deeds = 0
    with open(path, "w") as file:
        while frames < FRAMES:
            if deeds % DEEDS_OF_A_VISIT == 0:
                file.write(return_to_start(operator, deeds // DEEDS_OF_A_VISIT))
            text = deed(rng)
            deeds += 1
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


def resident_bytes(pid):
    with open(f"/proc/{pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def is_sanitized(program):
    with open(program, "rb") as file:
        return b"__asan_init" in file.read()


def bytes_in_use(folder):
    """What the window has told at the beginnings of its visits, oldest first."""
    names = sorted(name for name in os.listdir(folder) if name.startswith("in-use-"))
    samples = []
    for name in names:
        with open(os.path.join(folder, name)) as file:
            samples.append(int(file.read()))
    return samples


def line_along(samples):
    """The line of least squares through what follows the first third: where it begins and ends, and
    its slope from one sample to the next."""
    samples = samples[len(samples) // 3 :]
    middle = (len(samples) - 1) / 2
    mean = sum(samples) / len(samples)
    slope = sum((k - middle) * (y - mean) for k, y in enumerate(samples)) / sum(
        (k - middle) ** 2 for k in range(len(samples))
    )
    return mean - middle * slope, mean + middle * slope, slope


def grows(what, samples, of_a_deed=None):
    """Whether samples grow more than they may; says how much they do."""
    if len(samples) < FEWEST_SAMPLES:
        print(f"{what}: {len(samples)} samples are too few to tell growth; play longer")
        return True
    begin, end, slope = line_along(samples)
    growth = end / begin - 1
    text = f"{what}: {begin / 2**20:.2f} to {end / 2**20:.2f} MiB after the first third, {growth:+.2%}"
    if of_a_deed is None:
        print(text)
        return growth > MOST_GROWTH
    print(f"{text}, {slope / DEEDS_OF_A_VISIT:+.0f} bytes a deed; {len(samples)} samples")
    creeps = slope / DEEDS_OF_A_VISIT > of_a_deed and end - begin > UNSTEADY_BYTES
    return growth > MOST_GROWTH or creeps


def main():
    program, operator, minutes = sys.argv[1], os.path.abspath(sys.argv[2]), float(sys.argv[3])
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    with tempfile.TemporaryDirectory() as folder:
        visit = os.path.join(folder, "visit.txt")
        write_visit(visit, operator, random.Random(seed))
        said = open(os.path.join(folder, "said.txt"), "w+")
        window = subprocess.Popen(
            [os.path.abspath(program), operator, "--size", "%dx%d" % SIZE, "--replay", visit],
            cwd=folder,
            env={**os.environ, "LP_NUM_THREADS": "0"},
            stdout=subprocess.DEVNULL,
            stderr=said,
        )
        begin, resident = time.time(), []
        while window.poll() is None and time.time() - begin < 60 * minutes:
            time.sleep(5)
            if window.poll() is None:
                resident.append(resident_bytes(window.pid))
                if len(resident) % 12 == 0:
                    in_use = bytes_in_use(folder)[-1:] or [0]
                    print(
                        f"{time.time() - begin:6.0f} s  {resident[-1] / 2**20:8.1f} MiB resident  "
                        f"{in_use[0] / 2**20:8.2f} MiB in use",
                        flush=True,
                    )
        if window.poll() is None:
            window.send_signal(signal.SIGINT)
        status = window.wait()
        said.seek(0)
        text = said.read()
        said.close()
        in_use = bytes_in_use(folder)
    complaints = own_complaints(text)
    for complaint in complaints:
        print(complaint)
    # 3: stopped on request, 0: all was played before the time was over; a sanitizer that found
    # leaks, of whomever, makes another number of it.
    ended_well = status in (0, 3) or ("stopped on request" in text and " leak of " in text)
    print(f"exit status {status}")
    grown = grows("in use at the beginnings of visits", in_use, MOST_BYTES_A_DEED)
    if is_sanitized(program):
        # Its allocator never gives back what a size of block once took, and keeps what is freed in
        # quarantine: what is resident there tells of it, not of the window.
        print(f"resident, with the sanitizer: {resident[-1] / 2**20:.0f} MiB")
    else:
        grown = grows("resident", resident) or grown
    return 0 if ended_well and not complaints and not grown else 1


if __name__ == "__main__":
    sys.exit(main())
