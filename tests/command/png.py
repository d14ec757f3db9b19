# SPDX-License-Identifier: BSD-3-Clause
"""Image files for tests."""
import random
import struct
import zlib


def grey_png(rows):
    """The bytes of a grey PNG of these pixels, a list or bytes a row."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    header = struct.pack('>IIBBBBB', len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    data = b''.join(b'\0' + bytes(row) for row in rows)
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(data)) + chunk(b'IEND', b'')


def noise_png(width, height, seed=1):
    """The bytes of a grey PNG of noise."""
    generator = random.Random(seed)
    return grey_png([generator.randbytes(width) for _ in range(height)])
