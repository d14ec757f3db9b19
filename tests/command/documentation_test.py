# SPDX-License-Identifier: BSD-3-Clause
"""doc/parameters.md leaves out no option of the command and no key of the ini; links lead somewhere."""
import re

from command import SOURCE, CommandTest, main

PARAMETERS = (SOURCE / 'doc/parameters.md').read_text()
VERBS = (['simulate'], ['import', 'tum'], ['import', 'openloris'], ['import', 'images'], ['map'], ['localize'],
         ['evaluate'], ['relocalize'], ['estimate'], ['bench'], ['selector', 'data'],
         ['selector', 'choose'], ['selector', 'ask'])


class DocumentationTest(CommandTest):
    def test_every_option(self):
        for verb in VERBS:
            options = set(re.findall(r'(?m)^  (?:-\w,)?(--[\w-]+)', self.succeed(*verb, '--help'))) - {'--help'}
            for option in options:
                self.assertIn(f'`{option}`', PARAMETERS, verb)

    def test_every_key(self):
        sources = [SOURCE / 'libs/mrpt/src' / name for name in ('localization_config.cpp', 'visual_map_options.cpp')]
        for source in sources:
            keys = re.findall(r'(?:\.read|visit)\("(\w+)"', source.read_text())
            self.assertGreater(len(keys), 10)
            for key in keys:
                self.assertIn(f'`{key}`', PARAMETERS, source.name)

    def test_every_link(self):
        for document in (*SOURCE.glob('*.md'), *SOURCE.glob('doc/*.md')):
            for link in re.findall(r'\]\(([^)#]+)[^)]*\)', document.read_text()):
                if not link.startswith('http'):
                    self.assertTrue((document.parent / link).exists(), f'{document.name}: {link}')


if __name__ == '__main__':
    main()
