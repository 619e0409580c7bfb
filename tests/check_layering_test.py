#!/usr/bin/env python3
"""Breaks small trees on purpose, one rule at a time, and asks check_layering.py to notice."""

import tempfile
import unittest
from pathlib import Path

from check_layering import breaches, main

CLEAN = {
    "radiance4d/quad.h": "#include <vector>\n#include <Eigen/Core>\n",
    "radiance4d/visibility.cpp": '#include "radiance4d/quad.h"\n#include <embree3/rtcore.h>\n',
    "solver/oracle.h": '#include "radiance4d/quad.h"\n',
    "solver/oracle.cpp": '#include "solver/oracle.h"\n',
    "runtime/frame.h": '#include "radiance4d/quad.h"\n',
    "viewer/main.cpp": '#include "solver/oracle.h"\n#include "runtime/frame.h"\n',
    "tests/oracle_test.cpp": '#include "solver/oracle.h"\n#include "runtime/frame.h"\n',
    "tests/rooms.h": '#include <gtest/gtest.h>\n#include "radiance4d/quad.h"\n',
}


class Layering(unittest.TestCase):
    def breaches_with(self, **changed):
        """Breaches of the clean tree with some files added or replaced."""
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**CLEAN, **changed["files"]}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            self.status = main([folder]) if changed.get("run") else None
            return breaches(root)

    def expect(self, name, text, *words):
        found = self.breaches_with(files={name: text})
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])

    def test_a_clean_tree_passes(self):
        self.assertEqual(self.breaches_with(files={}, run=True), [])
        self.assertEqual(self.status, 0)

    def test_a_breach_gives_status_1(self):
        self.breaches_with(files={"solver/a.cpp": '#include "runtime/frame.h"\n'}, run=True)
        self.assertEqual(self.status, 1)

    def test_an_empty_tree_is_not_a_clean_one(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(main([folder]), 1)

    def test_solver_and_runtime_stay_apart(self):
        self.expect("solver/a.cpp", '\n#include "runtime/frame.h"\n', "solver/a.cpp:2", "runtime")
        self.expect("runtime/a.h", '#include "solver/oracle.h"\n', "runtime/a.h:1", "solver")

    def test_radiance4d_includes_neither(self):
        self.expect("radiance4d/a.h", '  #  include "solver/oracle.h"\n', "must not include solver")
        self.expect("radiance4d/a.h", '#include "runtime/frame.h"\n', "must not include runtime")

    def test_nothing_includes_viewer(self):
        for folder in ("radiance4d", "solver", "runtime"):
            found = self.breaches_with(
                files={
                    "viewer/window.h": "",
                    f"{folder}/a.cpp": '#include "viewer/window.h"\n',
                }
            )
            self.assertEqual(len(found), 1, found)
            self.assertIn("must not include viewer", found[0])

    def test_cycles_are_found(self):
        found = self.breaches_with(
            files={
                "solver/a.h": '#include "solver/b.h"\n',
                "solver/b.h": '#include "solver/c.h"\n',
                "solver/c.h": '#include "solver/a.h"\n',
            }
        )
        self.assertEqual(len(found), 1, found)
        self.assertIn("solver/a.h -> solver/b.h -> solver/c.h -> solver/a.h", found[0])
        self.expect("solver/a.h", '#include "solver/a.h"\n', "cycle")

    def test_two_ways_to_one_header_are_no_cycle(self):
        self.assertEqual(
            self.breaches_with(
                files={
                    "solver/a.h": '#include "solver/b.h"\n#include "solver/oracle.h"\n',
                    "solver/b.h": '#include "solver/oracle.h"\n',
                }
            ),
            [],
        )

    def test_third_party_headers_stay_in_cpp_files(self):
        for header in ("fmt/format.h", "embree3/rtcore.h", "zstd.h", "toml++/toml.h", "CLI/CLI.hpp"):
            self.expect("solver/a.h", f"#include <{header}>\n", "third-party", header)
        self.expect("solver/a.h", "#include <gtest/gtest.h>\n", "third-party")

    def test_includes_are_written_from_the_root(self):
        self.expect("solver/a.cpp", '#include "oracle.h"\n', "not the path of a header")
        self.expect("solver/a.cpp", '#include "solver/missing.h"\n', "not the path of a header")
        self.expect("solver/a.cpp", "#include <radiance4d/quad.h>\n", "written with quotes")


if __name__ == "__main__":
    unittest.main()
