# SPDX-License-Identifier: BSD-3-Clause
"""Image files for tests."""
import random
import struct
import zlib


def noise_png(width, height, seed=1):
    """The bytes of a grey PNG of noise."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    generator = random.Random(seed)
    rows = b''.join(b'\0' + generator.randbytes(width) for _ in range(height))
    header = struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b'')
