#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Joins pictures to an animated WebP that repeats for ever.

usage: join_frames.py OUT.webp RATE MOST_BYTES FRAME ...
The quality is the highest with which the file has at most MOST_BYTES.
"""
import io
import sys

from PIL import Image


def join(frames, rate, quality):
    out = io.BytesIO()
    frames[0].save(out, 'WEBP', save_all=True, append_images=frames[1:], loop=0, method=4,
                   duration=round(1000 / rate), quality=quality)
    return out.getvalue()


def main(out, rate, most_bytes, *names):
    frames = [Image.open(name).convert('RGB') for name in names]
    for quality in (85, 75, 65, 55, 45, 35, 25):
        film = join(frames, float(rate), quality)
        if len(film) <= int(most_bytes):
            with open(out, 'wb') as file:
                file.write(film)
            print('%s: %d frames, %d bytes, quality %d' % (out, len(frames), len(film), quality))
            return
    sys.exit('join_frames.py: %d frames do not fit %s bytes' % (len(frames), most_bytes))


if __name__ == '__main__':
    main(*sys.argv[1:])
