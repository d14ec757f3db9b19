#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names every place where a source tree breaks the rules of the house, one a line, and fails if there is one.

usage: architecture.py SOURCE_DIR

- A library includes itself and the floors below it only; no library includes the command.
- MRPT headers are included on floor 4 and above only.
- OpenCV headers are included by vision, study, mapping and datasets only, and never by a public header.
- Every source file starts with its licence and has at most 300 lines of at most 120 characters.
"""
import re
import sys
from os.path import normpath
from pathlib import Path

FLOORS = {'geometry': 0, 'estimation': 1, 'vision': 1, 'study': 2, 'mapping': 2, 'relocalization': 3, 'mrpt': 4,
          'datasets': 5, 'evaluation': 5}
MRPT_FLOOR = 4
OPENCV_LIBRARIES = {'vision', 'study', 'mapping', 'datasets'}
MAX_LINES = 300
MAX_COLUMNS = 120
LICENCE = 'SPDX-License-Identifier: BSD-3-Clause'
SOURCE_FOLDERS = ('libs', 'apps', 'tests', 'share')
SOURCE_SUFFIXES = {'.h', '.cpp', '.cmake', '.py', '.sh'}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def is_source(file):
    return file.suffix in SOURCE_SUFFIXES or file.name == 'CMakeLists.txt'


def form_violations(lines):
    """Licence, length and width; as (line number, what is wrong)."""
    if not any(LICENCE in line for line in lines[:2]):
        yield 1, f'no line "{LICENCE}" at the top'
    if len(lines) > MAX_LINES:
        yield len(lines), f'longer than {MAX_LINES} lines'
    for number, line in enumerate(lines, 1):
        if len(line) > MAX_COLUMNS:
            yield number, f'wider than {MAX_COLUMNS} characters'


def include_violation(path, header):
    """What is wrong with this file of libs/LIBRARY including this header, or None."""
    library, is_public = path.parts[1], path.parts[2] == 'include'
    top, _, rest = header.partition('/')
    if top == 'vmcl':
        included = rest.partition('/')[0]
        if included not in FLOORS:
            return f'includes {header}, which is no library'
        if included != library and FLOORS[included] >= FLOORS[library]:
            return f'{library} (floor {FLOORS[library]}) includes {header} (floor {FLOORS[included]})'
    elif top == 'mrpt' and FLOORS[library] < MRPT_FLOOR:
        return f'{library} (floor {FLOORS[library]}) includes an MRPT header'
    elif top in ('opencv2', 'opencv4'):
        if library not in OPENCV_LIBRARIES:
            return f'{library} includes an OpenCV header'
        if is_public:
            return 'a public header includes an OpenCV header'
    elif not normpath(path.parent / header).startswith(f'libs/{library}/'):
        return f'includes {header} from outside of its library'
    return None


def include_violations(path, lines):
    """path: of the file, relative to the source tree; only files of libs/ have rules."""
    if path.parts[0] != 'libs' or len(path.parts) < 3:
        return
    library = path.parts[1]
    if library not in FLOORS:
        yield 1, f'libs/{library} has no floor'
        return
    for number, line in enumerate(lines, 1):
        include = INCLUDE.match(line)
        wrong = include and include_violation(path, include[1])
        if wrong:
            yield number, wrong


def violations(root):
    files = [root / 'CMakeLists.txt'] + [f for folder in SOURCE_FOLDERS for f in sorted((root / folder).rglob('*'))]
    for file in files:
        if not file.is_file() or not is_source(file):
            continue
        path = file.relative_to(root)
        lines = file.read_text(encoding='utf-8').splitlines()
        for number, wrong in [*form_violations(lines), *include_violations(path, lines)]:
            yield f'{path}:{number}: {wrong}'


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(violations(Path(sys.argv[1])))
    print('\n'.join(found))
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
