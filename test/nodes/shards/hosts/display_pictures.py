# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of two displays, one of which shows shards and the other single nodes."""
import os

import numpy as np
from PIL import Image

from waiting import wait_for

NAMES = ('shards', 'whole')
STEP = 24  # of 255: pixels of a colour that differs by more count as different
PLANTS = 30.0  # least standard deviation of the colours of a picture that has plants
MOST_DIFFERENT = 0.002  # of all pixels
PATIENCE = 300.0  # [s] until displays have drawn what they have received


class DisplayPictures:
    """The pictures that rviz_frames writes to a folder once the file `end` is in it."""

    def __init__(self, folder):
        self._folder = folder

    def compare(self):
        """Waits for both pictures. Returns the share of pixels that differ, and whether both show plants and
        no more than MOST_DIFFERENT of the pixels differ."""
        with open(os.path.join(self._folder, 'end'), 'w', encoding='utf-8'):
            pass
        shards, whole = (self._read(name) for name in NAMES)
        share = float(np.mean(np.max(np.abs(shards - whole), axis=2) > STEP))
        return share, min(shards.std(), whole.std()) > PLANTS and share < MOST_DIFFERENT

    def _read(self, name):
        path = os.path.join(self._folder, name + '.png')
        out = []

        def is_whole():
            try:
                out.append(np.asarray(Image.open(path).convert('RGB'), dtype=np.int16))
            except (OSError, SyntaxError):  # not there yet, or a part of it
                return False
            return True

        wait_for(is_whole, path, PATIENCE)
        return out[-1]
