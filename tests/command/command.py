# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command and asks what a user may rely on: exit codes, one line a problem, whole outputs or none."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DONE, SOME_INPUT_BAD, FAILED = 0, 1, 2
SKIPPED = 77  # the exit code that ctest reports as skipped

BIN = Path(os.environ['VMCL_BIN'])  # where vmcl and spoil_rawlog are
LIB = Path(os.environ['VMCL_LIB'])  # where libvmcl-mrpt.so is
SOURCE = Path(os.environ['VMCL_SOURCE_DIR'])
SAMPLE = Path(os.environ['VMCL_SAMPLE_DIR'])  # what make_sample.py made
SHARED = SOURCE / '..' / 'shared'


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='vmcl-test-')
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def path(self, name):
        return self.folder / name

    def write(self, name, content):
        file = self.path(name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content.encode() if isinstance(content, str) else content)
        return file

    def copy(self, file, name=None):
        return Path(shutil.copy(file, self.path(name or Path(file).name)))

    def vmcl(self, *arguments, stdin=''):
        return subprocess.run([BIN / 'vmcl', *map(str, arguments)], input=stdin, text=True, errors='backslashreplace',
                              capture_output=True, cwd=self.folder, timeout=300, check=False)

    def spoil(self, log, how):
        """A copy of the sample's log, with its images, spoiled as spoil_rawlog knows how."""
        spoiled = self.path(f'{how}.rawlog')
        subprocess.run([BIN / 'spoil_rawlog', SAMPLE / log, how, spoiled], check=True, capture_output=True)
        images = self.path(f'{how}_Images')
        images.symlink_to(SAMPLE / (Path(log).stem + '_Images'))
        return spoiled

    def succeed(self, *arguments, stdin=''):
        """Runs the command, which must have nothing to complain about, and returns what it printed."""
        result = self.vmcl(*arguments, stdin=stdin)
        self.assertEqual((result.returncode, result.stderr), (DONE, ''))
        return result.stdout

    def assert_complaint(self, result, code, *words):
        """It ended with this code and one line on stderr that holds all of these words."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(str(word), result.stderr)

    def assert_refused(self, arguments, *words, stdin=''):
        """Nothing could be done: one line says so, and no file is left that was not there before."""
        before = sorted(self.folder.rglob('*'))
        self.assert_complaint(self.vmcl(*arguments, stdin=stdin), FAILED, *words)
        self.assertEqual(sorted(self.folder.rglob('*')), before)


def main():
    program = unittest.main(exit=False)
    result = program.result
    if result.wasSuccessful() and result.testsRun == len(result.skipped):
        sys.exit(SKIPPED)
    sys.exit(not result.wasSuccessful())
