#!/usr/bin/env python3
"""Holds the arrows of the house: which folder may include which, no cycles, no third party in headers.

usage: check_layering.py ROOT

Prints one line for each breach, "file:line: what is wrong", and exits with 1 if there is any.
"""

import re
import sys
from pathlib import Path

# Which folders the files of a folder may include. Tests may see everything.
MAY_INCLUDE = {
    "radiance4d": {"radiance4d"},
    "solver": {"radiance4d", "solver"},
    "runtime": {"radiance4d", "runtime"},
    "viewer": {"radiance4d", "solver", "runtime", "viewer"},
    "tests": {"radiance4d", "solver", "runtime", "viewer", "tests"},
}
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]*)"|<([^>]*)>)')
STANDARD_HEADER = re.compile(r"[a-z0-9_]+")


def includes_of(path):
    """(line number, quoted name or None, bracketed name or None) of each include."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1], match[2]


def may_stand_in_header(bracketed, folder):
    """Headers carry the standard library and Eigen; everything else stays behind them.

    Those of the tests may carry more, as nothing else includes them.
    """
    standard = STANDARD_HEADER.fullmatch(bracketed)
    return folder == "tests" or standard or bracketed.startswith("Eigen/")


def sources_below(root):
    return sorted(
        path
        for folder in MAY_INCLUDE
        for path in (root / folder).rglob("*")
        if path.suffix in (".h", ".cpp")
    )


def breaches_of_file(path, root):
    name = path.relative_to(root).as_posix()
    folder = name.split("/")[0]
    for number, quoted, bracketed in includes_of(path):
        place = f"{name}:{number}"
        if bracketed is not None:
            if path.suffix == ".h" and not may_stand_in_header(bracketed, folder):
                yield f"{place}: third-party header <{bracketed}> belongs in a .cpp file"
            target = bracketed.split("/")[0]
            if target in MAY_INCLUDE:
                yield f'{place}: <{bracketed}> is ours, and is written with quotes'
            continue
        target = quoted.split("/")[0]
        if target not in MAY_INCLUDE or not (root / quoted).is_file():
            yield f'{place}: "{quoted}" is not the path of a header from the root'
        elif target not in MAY_INCLUDE[folder]:
            yield f'{place}: {folder} must not include {target} ("{quoted}")'


def cycles(root):
    """One line for each include that closes a cycle."""
    files = {path.relative_to(root).as_posix(): path for path in sources_below(root)}
    graph = {
        name: [quoted for _, quoted, _ in includes_of(path) if quoted in files]
        for name, path in files.items()
    }
    finished = set()
    for start in graph:
        # Depth first; `trail` is the way from start, `pending` the includes not followed yet.
        trail, pending = [start], [iter(graph[start])]
        while trail:
            following = next(pending[-1], None)
            if following is None:
                finished.add(trail.pop())
                pending.pop()
            elif following in trail:
                circle = trail[trail.index(following) :] + [following]
                yield "include cycle: " + " -> ".join(circle)
            elif following not in finished:
                trail.append(following)
                pending.append(iter(graph[following]))


def breaches(root):
    found = [line for path in sources_below(root) for line in breaches_of_file(path, root)]
    return found + list(cycles(root))


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 1
    root = Path(arguments[0])
    if not sources_below(root):
        print(f"{root}: no sources here", file=sys.stderr)
        return 1
    found = breaches(root)
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
