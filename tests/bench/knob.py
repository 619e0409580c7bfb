#!/usr/bin/env python3
"""How well --error is kept: precomputes scenes for each error, and judges each file with unseen lamps.

usage: knob.py LIGHTWELL [--errors LIST] [--lights N] [--points N] [--seed S] [SCENE...]

SCENE is what `lightwell precompute` takes; the diffuse sample scenes by default. Prints one line for each scene and error as it is done,
and a table at the end: the error that `lightwell verify` finds over the one asked for, in
parentheses where `precompute` said that it did not reach it. Exits with 1 if any stands above 1
without a word, or above 1.5.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path


def output_of(command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def sample_scenes():
    folder = Path(__file__).resolve().parents[2] / "scenes"
    names = ["cornell-box", "corner", "two-rooms", "furnace", "maze", "office"]
    return [str(folder / name / "scene.toml") for name in names]


def name_of(scene):
    """The folder's name for scene files, which are all called alike."""
    path = Path(scene)
    return path.resolve().parent.name if path.name == "scene.toml" else path.stem


class Kept:
    """One scene at one error: what was asked, promised and found."""

    def __init__(self, lightwell, scene, asked, judge, folder):
        file = str(Path(folder) / "knob.gto")
        made = json.loads(output_of(
            [lightwell, "precompute", scene, "-o", file, "--error", str(asked), "--json"]))
        found = json.loads(output_of([lightwell, "verify", file, "--json", *judge]))
        self.asked = asked
        self.estimated = made["error_estimated"]
        self.bound = made["error_bound"]
        self.attempts = made["attempts"]
        self.seconds = made["seconds"]["total"]
        self.picture = found["picture"]["indirect"]["relative_l2"]
        self.measure = found["measure"]["indirect"]["relative_l2"]
        self.ratio = self.picture["value"] / asked
        self.promised = self.bound <= asked

    def broken(self):
        return self.ratio > 1.5 or (self.promised and self.ratio > 1)

    def line(self):
        def per_cent(value):
            return f"{100 * value:.2f}"

        return (
            f"{100 * self.asked:g} % asked, estimated {per_cent(self.estimated)} "
            f"(bound {per_cent(self.bound)}, {'kept' if self.promised else 'not kept, and said so'}), "
            f"found {per_cent(self.picture['value'])} "
            f"[{per_cent(self.picture['low'])}, {per_cent(self.picture['high'])}], "
            f"measure {per_cent(self.measure['value'])} %; "
            f"{self.attempts} attempts, {self.seconds:.1f} s")

    def cell(self):
        return f"{self.ratio:.2f}" if self.promised else f"({self.ratio:.2f})"


def print_table(errors, rows):
    columns = [["asked", *(f"{100 * error:g} %" for error in errors)]]
    columns += [[name, *(kept.cell() for kept in row)] for name, row in rows]
    for line in zip(*columns):
        print("| " + " | ".join(line) + " |")
        if line[0] == "asked":
            print("|---" * len(line) + "|")


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("lightwell")
    options.add_argument("scenes", nargs="*", metavar="SCENE", default=sample_scenes())
    options.add_argument("--errors", default="0.1,0.05,0.02", help="0.1,0.05,0.02 by default")
    options.add_argument("--lights", default="50", help="unseen lamps; 50 by default")
    options.add_argument("--points", default="32", help="surface points for each lamp; 32 by default")
    options.add_argument("--seed", default="1", help="of lamps and points; 1 by default")
    given = options.parse_intermixed_args()  # options may stand between scenes

    errors = [float(error) for error in given.errors.split(",")]
    judge = ["--lights", given.lights, "--points", given.points, "--seed", given.seed]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for scene in given.scenes:
            row = []
            for error in errors:
                row.append(Kept(given.lightwell, scene, error, judge, folder))
                print(f"{name_of(scene)}: {row[-1].line()}", file=sys.stderr, flush=True)
            rows.append((name_of(scene), row))
    print_table(errors, rows)
    return 1 if any(kept.broken() for _, row in rows for kept in row) else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except subprocess.CalledProcessError as failure:
        # What went wrong stands on standard error already.
        sys.exit(failure.returncode)
