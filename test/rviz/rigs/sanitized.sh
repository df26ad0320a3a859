#!/bin/bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs a display's test that was built with the address sanitizer. To be linked with it, not to
# preload it, matters: preloaded it starts within the first allocation, which is libp11-kit's
# newlocale; its own first message then unlocks the lock of all locales once too often, and whoever
# needs that lock later (Mesa's first regular expression, Qt's exit) waits for ever.
here=$(dirname "$0")
# Ogre deletes some of its own through a base of another size.
export ASAN_OPTIONS=new_delete_type_mismatch=0
export LSAN_OPTIONS=suppressions=$here/leaks_of_others.txt:print_suppressions=0
exec "$@"
