#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""What script/mutate takes for noticed, and what it says where the machine is too busy to tell."""
import csv
import io
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from types import SimpleNamespace

sys.dont_write_bytecode = True
import suite

try:
    import mutate
except ModuleNotFoundError:  # of clang
    sys.exit(77)

SLOW = "sleep 60"
BY_MUTANT = "${RHW_MUTANT:+false}"


def shell(text):
    return suite.Test(text, ["sh", "-c", text], "/", {}, 77)


class Suite(unittest.TestCase):
    def setUp(self):
        self.least, suite.LEAST = suite.LEAST, 2

    def tearDown(self):
        suite.LEAST = self.least

    def notice(self, *texts):
        tests = [shell(text) for text in texts]
        for test in tests:
            test.reached = {1}
        return suite.notice(tests, 1, 60)

    def test_look(self):
        with tempfile.TemporaryDirectory() as folder:
            tests = [shell(text) for text in ("true", SLOW, "false", "exit 77")]
            good, slow, failed = suite.look(tests, 2, Path(folder, "reached"))
        self.assertEqual([test.name for test in good], ["true"])
        self.assertEqual((slow, failed), ([SLOW], ["false"]))

    def test_notice(self):
        self.assertEqual(self.notice("true"), (None, 1, 0))
        self.assertEqual(self.notice("true", BY_MUTANT), (BY_MUTANT, 2, 0))
        endless = f"test -z $RHW_MUTANT || {SLOW}"
        self.assertEqual(self.notice(endless), (endless, 1, 0))
        self.assertEqual(self.notice(SLOW, "true"), (None, 2, 1))

    def test_without_tests(self):
        for slow, failed, told in ([SLOW], [], "1 take longer than 3 s"), ([], ["a"], "1 fail"), ([], [], "none has such a name"):
            with self.assertRaisesRegex(SystemExit, told):
                mutate.tell_tests([], slow, failed, 3)
        out = io.StringIO()
        with redirect_stdout(out):
            mutate.tell_tests([shell("true")], [SLOW], [], 3)
        self.assertRegex(out.getvalue(), f"^1 tests that pass in time\n1 take longer than 3 s .*: {SLOW}\n$")

    def test_save(self):
        place = SimpleNamespace(file="a.c", line=7, kind="number", told="1 with 2")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "mutants.csv")
            mutate.save(path, [(place, None, 5, 4, 3)])
            with open(path, newline="") as file:
                (row,) = csv.DictReader(file)
        self.assertEqual((row["noticed by"], row["tests run"], row["timed out without it too"]), ("", "5", "3"))


if __name__ == "__main__":
    unittest.main()
